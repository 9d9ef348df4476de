import type { TableBlock } from './content';
import { el } from './dom';

/** What a cell is sorted by: minutes and seconds, a number, or its text. */
function key(text: string): number | string {
    const clock = /^(−?)(\d+):(\d\d(?:\.\d+)?)/.exec(text);
    if (clock) return (clock[1] ? -1 : 1) * (60 * Number(clock[2]) + Number(clock[3]));
    const number = /^[≤≥+]?\s*(−?[\d,]+(?:\.\d+)?)/.exec(text);
    return number ? Number(number[1].replace('−', '-').replaceAll(',', '')) : text;
}

function compare(a: number | string, b: number | string): number {
    if (typeof a === 'number' && typeof b === 'number') return a - b;
    if (typeof a === typeof b) return String(a).localeCompare(String(b));
    return typeof a === 'number' ? -1 : 1;
}

/** A table whose heads sort it: up, down, as it was. */
export function table(block: TableBlock): HTMLElement {
    const badRows = new Set(block.bad), badCells = new Set(block.badCells.map(([row, column]) => `${row} ${column}`));
    const rows = block.rows.map((cells, r) => {
        const row = el('tr', badRows.has(r) ? { class: 'bad' } : {});
        cells.forEach((text, c) => {
            const bad = badCells.has(`${r} ${c}`), words = [block.columns[c].numeric ? 'number' : '', bad ? 'bad' : ''].join(' ').trim();
            row.append(el('td', words ? { class: words } : {}, bad ? `${text}*` : text));
        });
        return row;
    });
    const body = el('tbody', {}, ...rows), heads: HTMLTableCellElement[] = [];
    let sorted = -1, direction = 0;
    const sort = (column: number) => {
        direction = sorted === column ? (direction === 1 ? -1 : direction === -1 ? 0 : 1) : 1;
        sorted = column;
        const order = rows.map((_, i) => i);
        if (direction) order.sort((a, b) => direction * compare(key(block.rows[a][column]), key(block.rows[b][column])) || a - b);
        body.append(...order.map((i) => rows[i]));
        heads.forEach((head, c) => head.setAttribute('aria-sort', c !== column || !direction ? 'none' : direction > 0 ? 'ascending' : 'descending'));
    };
    const head = el('tr');
    block.columns.forEach((column, c) => {
        const cell = el('th', { scope: 'col', 'aria-sort': 'none', class: column.numeric ? 'number' : '' });
        const button = el('button', { type: 'button', title: 'Sort' }, column.title || (c === 0 ? '#' : 'Verdict'));
        button.addEventListener('click', () => sort(c));
        cell.append(button);
        heads.push(cell);
        head.append(cell);
    });
    const whole = el('table', { id: `table-${block.name}` }, el('thead', {}, head), body);
    if (block.caption) whole.prepend(el('caption', {}, block.caption));
    return el('div', { class: 'scroll', tabindex: '0', role: 'region', 'aria-label': block.caption || block.name }, whole);
}

/** A long table is built when it is opened. */
export function foldedTable(block: TableBlock): HTMLElement {
    const fold = el('details', { class: 'screen' }, el('summary', {}, `${block.caption} (${block.rows.length.toLocaleString('en')})`));
    fold.addEventListener('toggle', () => fold.open && fold.childElementCount === 1 && fold.append(table(block)));
    return fold;
}
