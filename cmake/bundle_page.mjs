// Bundles FOLDER/src (page.html, style.css, main.ts) into one HTML page that needs nothing else. page.html holds @@STYLE@@ and
// @@SCRIPT@@, filled here, and marks like @@TITLE@@, each once, which the program fills (export/bytes/html_page.hpp).
// usage: node bundle_page.mjs FOLDER [OUTPUT]
import { mkdirSync, readFileSync, writeFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import { dirname, join, resolve } from 'node:path';

const folder = resolve(process.argv[2]);
const output = resolve(process.argv[3] ?? join(folder, 'dist', 'page.html'));
const { build } = createRequire(join(folder, 'package.json'))('esbuild');
const bundle = async (entry) => {
    const result = await build({
        entryPoints: [join(folder, 'src', entry)],
        absWorkingDir: folder,
        bundle: true,
        minify: true,
        write: false,
        format: 'iife',
        target: 'es2022',
        charset: 'utf8',
        legalComments: 'inline',
        logLevel: 'warning',
    });
    return result.outputFiles[0].text.trim();
};
const style = await bundle('style.css');
const script = await bundle('main.ts');
if (/<\/script/i.test(script)) throw new Error('the bundle would close its own script element');
const frame = readFileSync(join(folder, 'src', 'page.html'), 'utf8');
const marks = frame.match(/@@\w+@@/g) ?? [];
if (new Set(marks).size !== marks.length) throw new Error(`page.html holds a mark twice: ${marks.join(' ')}`);
const page = frame.replace('@@STYLE@@', () => style).replace('@@SCRIPT@@', () => script);
if (marks.some((mark) => `${style}${script}`.includes(mark))) throw new Error('the bundle holds a mark of the page');
mkdirSync(dirname(output), { recursive: true });
writeFileSync(output, page);
