import { chart, redrawCharts } from './chart';
import type { Block, Cover, Fact, Report, Section } from './content';
import { el } from './dom';
import { plan } from './plan';
import { foldedTable, table } from './table';

const report: Report = JSON.parse(document.getElementById('report')!.textContent!);
const place = (id: string) => document.getElementById(id)!;

function facts(list: Fact[]): HTMLElement {
    return el('dl', { class: 'facts' }, ...list.flatMap(([name, value]) => [el('dt', {}, name), el('dd', {}, value)]));
}

function draw(block: Block): HTMLElement {
    switch (block.kind) {
        case 'words':
            return el('p', { class: block.tone }, block.text);
        case 'facts':
            return facts(block.facts);
        case 'table':
            return block.screenOnly ? foldedTable(block) : table(block);
        case 'chart':
            return chart(block);
        case 'plan':
            return plan(block);
    }
}

function front(cover: Cover): HTMLElement {
    const verdict = el('div', { class: `verdict ${cover.certified ? 'good' : 'bad'}` }, el('p', { class: 'word', id: 'verdict' }, cover.verdict), el('p', {}, cover.statement));
    if (cover.reasons.length) verdict.append(el('ul', {}, ...cover.reasons.map((reason) => el('li', {}, reason))));
    const hash = el('p', { class: 'hash' }, el('span', {}, 'Show hash'), el('code', { id: 'hash' }, cover.hash.join(' ')));
    const figures = el('div', { class: 'figures' }, ...cover.figures.map((f) => el('div', {}, el('span', {}, f.name), el('strong', {}, f.value), el('span', {}, f.detail))));
    const columns = el('div', { class: 'columns' }, el('section', {}, el('h3', {}, 'Show'), facts(cover.facts)), el('section', {}, el('h3', {}, 'Limits'), facts(cover.limits)));
    const signing = cover.signing.length
        ? el('div', { class: 'signing' }, ...cover.signing.map((what) => el('div', {}, what)))
        : el('p', { class: 'unsigned' }, 'Not to be signed: this show may not be flown.');
    return el('section', { id: 'cover' }, verdict, hash, figures, columns, el('h3', {}, 'What else this report says'), facts(cover.findings), signing);
}

function sectionOf(section: Section): HTMLElement {
    const whole = el('section', { id: section.name }, el('h2', {}, section.title));
    if (section.meaning) whole.append(el('p', { class: 'meaning' }, section.meaning));
    whole.append(...section.blocks.map(draw));
    return whole;
}

const { cover } = report;
if (!cover.certified) {
    place('banner').hidden = false;
    place('banner').append(el('span', {}, cover.verdict));
    document.body.classList.add('failing');
}
place('top').append(el('p', {}, 'Flight validation report'), el('h1', {}, cover.title));
place('contents').append(...report.sections.map((s) => el('a', { href: `#${s.name}` }, s.title)));
place('report-body').append(front(cover), ...report.sections.map(sectionOf));
place('foot').textContent = `${report.program} · ${cover.title} · hash ${report.hash} · ${cover.verdict}`;

const kPaperPixels = 680;
let waiting = 0;
addEventListener('resize', () => {
    cancelAnimationFrame(waiting);
    waiting = requestAnimationFrame(() => redrawCharts());
});
matchMedia('(prefers-color-scheme: dark)').addEventListener('change', () => redrawCharts());
addEventListener('beforeprint', () => {
    document.documentElement.classList.add('paper');
    redrawCharts(kPaperPixels);
});
addEventListener('afterprint', () => {
    document.documentElement.classList.remove('paper');
    redrawCharts();
});
