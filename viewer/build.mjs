// Makes dist/: the pages of scripts, of tilesets and of shared models, the same bytes for the same sources. The page of a shared
// model has its script and its styles in itself, and places for the model.

import { readFileSync, writeFileSync } from 'node:fs';
import { build } from 'esbuild';

const here = new URL('./', import.meta.url);
const path = (name) => new URL(name, here).pathname;

// The renderer of tilesets and the editor are in scripts of their own, so that the page of scripts does not grow.
const scripts = {
  bundle: true,
  minify: true,
  format: 'iife',
  target: ['chrome111', 'firefox114', 'safari16.4'],
  charset: 'utf8',
  legalComments: 'inline',
  logLevel: 'warning',
};
const styles = { minify: true, target: scripts.target, logLevel: 'warning' };
// The page is painted once before its script runs, because shaders take their time. A hidden page is not painted.
const painted = {
  banner: {
    js: '((start)=>{let once=()=>{once=()=>{};start()};requestAnimationFrame(()=>setTimeout(()=>once()));setTimeout(()=>once(),300)})(()=>{',
  },
  footer: { js: '});' },
};
await build({
  ...scripts,
  ...painted,
  entryPoints: { viewer: path('src/main.js'), tileset: path('src/tileset/main.js') },
  outdir: path('dist'),
});
await build({
  ...scripts,
  entryPoints: { editor: path('src/editor/main.js') },
  outdir: path('dist'),
  globalName: 'burgeonEditor',
});
await build({
  ...styles,
  entryPoints: { viewer: path('src/style.css'), tileset: path('src/tileset/style.css') },
  outdir: path('dist'),
});

/** The text that `settings` make of one file. */
async function text(settings) {
  const { outputFiles } = await build({ ...settings, write: false });
  return outputFiles[0].text.trim();
}
const script = await text({ ...scripts, entryPoints: [path('src/shared/main.js')] });
const bare = await text({ ...styles, entryPoints: [path('src/style.css')] });
const style = `${bare}${await text({ ...styles, entryPoints: [path('src/shared/style.css')] })}`;
if (/<\/script|<!--|{{\w+}}/i.test(script) || /<\/style|{{\w+}}/i.test(style))
  throw new Error('the bundle has a text that ends its element, or that looks like a place');

// What stands between <!--script--> and <!--/script--> is for scripts alone, and so for the other kinds.
const page = readFileSync(path('page.html'), 'utf8');
const kinds = {
  index: ['script', 'served', 'model'],
  tileset: ['tileset', 'served'],
  shared: ['shared', 'model'],
};
const all = [...new Set(Object.values(kinds).flat())];
for (const [name, own] of Object.entries(kinds)) {
  const left = all
    .filter((kind) => !own.includes(kind))
    .reduce((rest, kind) => rest.replace(new RegExp(`<!--${kind}-->[^]*?<!--/${kind}-->\\n?`, 'g'), ''), page)
    .replace(/<!--\/?\w+-->\n?/g, '')
    .replace(/^ +/gm, '')
    .replace(/\n+/g, '\n')
    .replace('{{style}}', () => style)
    .replace('{{script}}', () => script);
  writeFileSync(path(`dist/${name}.html`), left);
}
