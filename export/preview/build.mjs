// Bundles the viewer into one HTML page with two marks, @@TITLE@@ and @@SHOW@@, which the writer fills (preview_html.cpp).
// usage: node build.mjs [OUTPUT]
import { build } from 'esbuild';
import { mkdirSync, readFileSync, writeFileSync } from 'node:fs';
import { dirname, join, resolve } from 'node:path';
import { fileURLToPath } from 'node:url';

const here = dirname(fileURLToPath(import.meta.url));
const output = resolve(process.argv[2] ?? join(here, 'dist', 'viewer.html'));
const bundle = async (entry, loader) => {
    const result = await build({
        entryPoints: [join(here, 'src', entry)],
        bundle: true,
        minify: true,
        write: false,
        format: 'iife',
        target: 'es2022',
        charset: 'utf8',
        legalComments: 'inline',
        logLevel: 'warning',
        loader,
    });
    return result.outputFiles[0].text.trim();
};
const script = await bundle('main.ts', {});
const style = await bundle('style.css', {});
if (/<\/script/i.test(script)) throw new Error('the bundle would close its own script element');
const page = readFileSync(join(here, 'src', 'page.html'), 'utf8')
    .replace('@@STYLE@@', () => style)
    .replace('@@SCRIPT@@', () => script);
for (const mark of ['@@TITLE@@', '@@SHOW@@']) {
    if (page.split(mark).length !== 2) throw new Error(`the page must hold ${mark} once`);
}
mkdirSync(dirname(output), { recursive: true });
writeFileSync(output, page);
