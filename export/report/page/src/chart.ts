import uPlot from 'uplot';
import type { ChartBlock } from './content';
import { clock, colour, el, fixed } from './dom';

const kHeight = 250;
const kSteps = [1, 2, 5, 10, 15, 30, 60, 120, 300, 600, 1800, 3600];
const all: { plot: uPlot; box: HTMLElement }[] = [];

const strokes = ['line-1', 'line-2', 'line-3'];
const dashes = [undefined, undefined, [2, 3]];

/** Formations as grey bands with their names, under the lines. */
function drawBands(u: uPlot, block: ChartBlock): void {
    const { ctx } = u, { left, top, width, height } = u.bbox, right = left + width;
    ctx.save();
    ctx.font = `${10 * devicePixelRatio}px system-ui, sans-serif`;
    ctx.textAlign = 'center';
    let free = left;
    for (const band of block.bands) {
        const from = Math.max(u.valToPos(band.from, 'x', true), left), to = Math.min(u.valToPos(band.to, 'x', true), right);
        if (to < left || from > right) continue;
        ctx.fillStyle = colour('band');
        ctx.fillRect(from, top, Math.max(to - from, devicePixelRatio), height);
        const middle = (from + to) / 2, half = ctx.measureText(band.name).width / 2;
        if (middle - half < free || middle + half > right) continue;
        ctx.fillStyle = colour('dim');
        ctx.fillText(band.name, middle, top + 11 * devicePixelRatio);
        free = middle + half + 4;
    }
    ctx.restore();
}

function drawLimits(u: uPlot, block: ChartBlock): void {
    const { ctx } = u, { left, top, width } = u.bbox;
    const heights: number[] = [];
    ctx.save();
    ctx.font = `600 ${10 * devicePixelRatio}px system-ui, sans-serif`;
    ctx.textAlign = 'right';
    for (const limit of block.limits) {
        const y = u.valToPos(limit.value, 'y', true);
        ctx.strokeStyle = ctx.fillStyle = colour(block.lines.length > 1 && block.limits.length > 1 ? strokes[limit.line] : 'bad');
        ctx.setLineDash([6 * devicePixelRatio, 4 * devicePixelRatio]);
        ctx.beginPath();
        ctx.moveTo(left, y);
        ctx.lineTo(left + width, y);
        ctx.stroke();
        const beside = heights.filter((other) => Math.abs(other - y) < 12 * devicePixelRatio).length;
        heights.push(y);
        const text = `${limit.name} ${fixed(limit.value, 2)}`, wide = ctx.measureText(text).width;
        const right = left + width - (3 + 110 * beside) * devicePixelRatio, base = Math.max(y - 3 * devicePixelRatio, top + 10 * devicePixelRatio), ink = ctx.fillStyle;
        ctx.fillStyle = colour('ground');
        ctx.globalAlpha = 0.8;
        ctx.fillRect(right - wide - 2, base - 9 * devicePixelRatio, wide + 4, 11 * devicePixelRatio);
        ctx.globalAlpha = 1;
        ctx.fillStyle = ink;
        ctx.fillText(text, right, base);
    }
    ctx.restore();
}

function options(block: ChartBlock, width: number): uPlot.Options {
    const isClock = block.xUnit === 'min:s', unit = block.unit === 'count' ? '' : ` ${block.unit}`;
    const shown = (value: number | null) => (value === null ? '–' : block.bars ? value.toLocaleString('en') : `${fixed(value, 3)}${unit}`);
    const axis = { stroke: () => colour('dim'), grid: { stroke: () => colour('grid'), width: 1 }, ticks: { stroke: () => colour('grid'), width: 1 }, font: '11px system-ui, sans-serif' };
    return {
        width,
        height: kHeight,
        cursor: { sync: isClock ? { key: 'show-time' } : undefined, drag: { x: true, y: false } },
        scales: {
            x: { time: false, range: block.bars ? (_u, low, high) => [low, high + block.x[1] - block.x[0]] : undefined },
            y: {
                range: (_u, low, high) => {
                    const values = block.limits.map((limit) => limit.value), top = Math.max(high ?? 1, ...values, 1e-9), bottom = Math.min(0, low ?? 0, ...values);
                    return [bottom, top + 0.08 * (top - bottom)];
                },
            },
        },
        axes: [
            { ...axis, incrs: isClock ? kSteps : undefined, values: isClock ? (_u: uPlot, at: number[]) => at.map((t) => clock(t)) : undefined },
            { ...axis, size: block.bars ? 84 : 56, values: block.bars ? (_u: uPlot, at: number[]) => at.map((n) => n.toLocaleString('en')) : undefined },
        ],
        series: [
            { label: isClock ? 'time' : block.xUnit, value: (_u, x) => (x === null ? '–' : isClock ? clock(x, 1) : `from ${fixed(x, 2)} ${block.xUnit}`) },
            ...block.lines.map((line, i): uPlot.Series => ({
                label: line.name,
                stroke: () => colour(strokes[i % 3]),
                fill: block.bars ? () => colour('line-1') : undefined,
                width: block.bars ? 0 : 1.6,
                dash: dashes[i % 3],
                points: { show: false },
                paths: block.bars ? uPlot.paths.bars!({ size: [0.86], align: 1 }) : undefined,
                value: (_u, value) => shown(value),
            })),
        ],
        hooks: { drawClear: [(u) => drawBands(u, block)], draw: [(u) => drawLimits(u, block)] },
    };
}

/** Legend entries can be reached and switched by keys as well. */
function keyedLegend(plot: uPlot): void {
    plot.root.querySelectorAll<HTMLElement>('.u-legend .u-series').forEach((row, i) => {
        const head = row.querySelector('th');
        if (i === 0 || !head) return;
        head.tabIndex = 0;
        head.setAttribute('role', 'switch');
        head.setAttribute('aria-checked', 'true');
        head.title = 'Show or hide';
        const toggled = () => head.setAttribute('aria-checked', String(plot.series[i].show));
        head.addEventListener('click', () => requestAnimationFrame(toggled));
        head.addEventListener('keydown', (event) => {
            if (event.key !== 'Enter' && event.key !== ' ') return;
            event.preventDefault();
            plot.setSeries(i, { show: !plot.series[i].show });
            toggled();
        });
    });
}

/** Arrows move the readout, + and − come closer around it, 0 shows everything. */
function keys(plot: uPlot, block: ChartBlock, event: KeyboardEvent): void {
    const x = block.x, first = x[0], last = x[x.length - 1];
    const at = plot.cursor.idx ?? Math.floor(x.length / 2);
    const zoom = (factor: number) => {
        const { min, max } = plot.scales.x, middle = x[at], half = ((max! - min!) / 2) * factor;
        plot.setScale('x', { min: Math.max(first, middle - half), max: Math.min(last, middle + half) });
    };
    const move = (by: number) => {
        const to = Math.min(Math.max(at + by, 0), x.length - 1);
        plot.setCursor({ left: plot.valToPos(x[to], 'x'), top: plot.over.clientHeight / 2 });
    };
    const step = event.shiftKey ? Math.ceil(x.length / 50) : 1;
    if (event.key === 'ArrowRight') move(step);
    else if (event.key === 'ArrowLeft') move(-step);
    else if (event.key === '+' || event.key === '=') zoom(0.5);
    else if (event.key === '-') zoom(2);
    else if (event.key === '0' || event.key === 'Escape') plot.setScale('x', { min: first, max: last });
    else return;
    event.preventDefault();
}

/** What the chart shows, for those who do not see it. */
function summary(block: ChartBlock): string {
    const parts = block.lines.map((line) => {
        const values = line.values.filter((v): v is number => v !== null);
        return values.length ? `${line.name}: ${fixed(Math.min(...values), 2)} to ${fixed(Math.max(...values), 2)} ${block.unit}` : `${line.name}: none`;
    });
    return [block.title, ...parts, ...block.limits.map((l) => `${l.name} ${fixed(l.value, 2)}`), 'Arrows read out, plus and minus zoom, 0 shows all'].join('. ');
}

export function chart(block: ChartBlock): HTMLElement {
    const unit = block.unit === 'count' ? '' : ` (${block.unit})`;
    const box = el('div', { class: 'chart', tabindex: '0', role: 'group', id: `chart-${block.name}`, 'aria-label': summary(block) });
    const figure = el('figure', {}, el('figcaption', {}, `${block.title}${unit}`), box);
    requestAnimationFrame(() => {
        const data = [block.x, ...block.lines.map((line) => line.values)] as uPlot.AlignedData;
        const plot = new uPlot(options(block, Math.max(box.clientWidth, 280)), data, box);
        keyedLegend(plot);
        box.addEventListener('keydown', (event) => event.target === box && keys(plot, block, event));
        all.push({ plot, box });
    });
    return figure;
}

/** After the window, the colours or the medium changed. @param width  of paper; absent: of the place on the screen. */
export function redrawCharts(width?: number): void {
    for (const { plot, box } of all) {
        plot.setSize({ width: width ?? Math.max(box.clientWidth, 280), height: kHeight });
        plot.redraw(false, true);
    }
}
