// Checks glTF files with Khronos' validator: node tests/validate.mjs FILE...
// The npm package gltf-validator is found through NODE_PATH, or in the folder GLTF_VALIDATOR.
import { readFile } from "node:fs/promises";
import { createRequire } from "node:module";
import { dirname, join, resolve } from "node:path";

const folder = process.env.GLTF_VALIDATOR;
// A CommonJS lookup, since only that reads NODE_PATH.
const require = createRequire(folder ? join(resolve(folder), "here.js") : import.meta.url);

let validator;
try {
  validator = require("gltf-validator");
} catch {
  console.error("gltf-validator is not installed\n  help: npm install gltf-validator, and set GLTF_VALIDATOR to that folder");
  process.exit(2);
}

const files = process.argv.slice(2).filter((argument) => argument !== "--all");
const all = process.argv.includes("--all");
if (files.length === 0) {
  console.error("usage: node tests/validate.mjs [--all] FILE...   (--all lists hints too)");
  process.exit(2);
}

// Tangents are optional in glTF: viewers find those of normal maps from the texture coordinates (MikkTSpace).
const ACCEPTED = new Set(["MESH_PRIMITIVE_GENERATED_TANGENT_SPACE"]);
const severities = ["error", "warning", "information", "hint"];
let failed = 0;
for (const file of files) {
  let messages;
  try {
    const report = await validator.validateBytes(new Uint8Array(await readFile(file)), {
      uri: file,
      maxIssues: 100,
      externalResourceFunction: async (uri) =>
        new Uint8Array(await readFile(join(dirname(file), decodeURIComponent(uri)))),
    });
    messages = report.issues.messages;
  } catch (error) {
    messages = [{ severity: 0, code: "UNREADABLE", message: String(error), pointer: "" }];
  }
  const bad = messages.filter(({ severity, code }) => severity <= 1 && !ACCEPTED.has(code));
  if (bad.length > 0) failed += 1;
  for (const { severity, code, message, pointer } of all ? messages : bad) {
    console.log(`${file}: ${severities[severity]} ${code} ${pointer ?? ""}: ${message}`);
  }
}
console.log(`${files.length - failed} passed, ${failed} failed`);
process.exit(failed > 0 ? 1 : 0);
