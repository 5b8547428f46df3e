// Every crate in Cargo.lock may be used: its licence is one of these, and it comes from crates.io or from this tree.
// Of a crate in two versions it only tells.
import { execFileSync } from "node:child_process";

const ALLOWED = new Set([
  "0BSD", "Apache-2.0", "Apache-2.0 WITH LLVM-exception", "BSD-2-Clause", "BSD-3-Clause", "BSL-1.0", "CC0-1.0", "ISC",
  "MIT", "MIT-0", "MPL-2.0", "Unicode-3.0", "Unlicense", "Zlib",
]);
const CRATES_IO = "registry+https://github.com/rust-lang/crates.io-index";

// Whether an SPDX expression leaves a choice of allowed licences alone. AND binds closer than OR; a slash is an old OR.
export function allowed(expression) {
  const tokens = expression.replaceAll("/", " OR ").match(/[()]|[^\s()]+/g) ?? [];
  let at = 0;
  const either = () => {
    let good = both();
    while (tokens[at] === "OR") {
      at += 1;
      good = both() || good;
    }
    return good;
  };
  const both = () => {
    let good = one();
    while (tokens[at] === "AND") {
      at += 1;
      good = one() && good;
    }
    return good;
  };
  const one = () => {
    if (tokens[at] === "(") {
      at += 1;
      const good = either();
      if (tokens[at] !== ")") throw new Error(`${expression} is no licence expression`);
      at += 1;
      return good;
    }
    let name = tokens[at];
    at += 1;
    if (tokens[at] === "WITH") {
      name += ` WITH ${tokens[at + 1]}`;
      at += 2;
    }
    return ALLOWED.has(name);
  };
  const good = either();
  if (at !== tokens.length) throw new Error(`${expression} is no licence expression`);
  return good;
}

// What the check itself says of expressions whose answer is known.
for (const [expression, expected] of [
  ["MIT OR Apache-2.0", true],
  ["MIT/Apache-2.0", true],
  ["GPL-3.0-only OR MIT", true],
  ["GPL-3.0-only", false],
  ["MIT AND GPL-3.0-only", false],
  ["(MIT OR Apache-2.0) AND Unicode-3.0", true],
  ["MIT OR GPL-3.0-only AND Zlib", true],
  ["Apache-2.0 WITH LLVM-exception", true],
  ["GPL-2.0 WITH Classpath-exception-2.0", false],
]) {
  if (allowed(expression) !== expected) throw new Error(`${expression}: not ${expected}`);
}

const options = { encoding: "utf8", maxBuffer: 1 << 28 };
const { packages } = JSON.parse(execFileSync("cargo", ["metadata", "--format-version", "1", "--locked"], options));
const problems = [];
const versions = new Map();
for (const { name, version, license, source } of packages) {
  if (license === null) problems.push(`${name} ${version} names no licence`);
  else if (!allowed(license)) problems.push(`${name} ${version} is under ${license}`);
  if (source !== null && source !== CRATES_IO) problems.push(`${name} ${version} comes from ${source}`);
  versions.set(name, [...(versions.get(name) ?? []), version]);
}
for (const [name, found] of versions) {
  if (found.length > 1) console.log(`${name} is here in ${found.length} versions: ${found.join(", ")}`);
}
problems.forEach((problem) => console.error(problem));
console.log(`${packages.length} crates, ${problems.length} problems`);
process.exitCode = problems.length === 0 ? 0 : 1;
