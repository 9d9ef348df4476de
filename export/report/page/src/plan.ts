import type { PlanBlock } from './content';
import { el, fixed, svg } from './dom';

interface View { x: number; y: number; width: number; height: number }

function extent(block: PlanBlock): View {
    let [x0, y0, x1, y1] = [Infinity, Infinity, -Infinity, -Infinity];
    for (const layer of block.layers)
        for (const shape of layer.shapes)
            for (let i = 0; i + 1 < shape.length; i += 2) {
                x0 = Math.min(x0, shape[i]);
                x1 = Math.max(x1, shape[i]);
                y0 = Math.min(y0, -shape[i + 1]);
                y1 = Math.max(y1, -shape[i + 1]);
            }
    if (!(x0 <= x1)) return { x: -1, y: -1, width: 2, height: 2 };
    const rim = 0.05 * Math.max(x1 - x0, y1 - y0, 1);
    return { x: x0 - rim, y: y0 - rim, width: x1 - x0 + 2 * rim, height: y1 - y0 + 2 * rim };
}

/** Down the page is −y. Homes are dots: lines without length and with round ends. */
function path(layer: string, shape: number[]): string {
    const points: string[] = [];
    for (let i = 0; i + 1 < shape.length; i += 2) {
        const at = `${shape[i]} ${-shape[i + 1]}`;
        points.push(layer === 'home' ? `M${at}h0` : `${i ? 'L' : 'M'}${at}`);
    }
    return points.join('') + (layer === 'home' || layer === 'track' ? '' : 'Z');
}

function roundLength(most: number): number {
    const power = 10 ** Math.floor(Math.log10(most));
    return [5, 2, 1].map((f) => f * power).find((length) => length <= most) ?? power;
}

export function plan(block: PlanBlock): HTMLElement {
    const whole = extent(block);
    let view = { ...whole };
    const picture = svg('svg', { role: 'img', 'aria-label': `${block.title}. Right is ${block.across}, up is ${block.up}`, preserveAspectRatio: 'xMidYMid meet' });
    const names = svg('g', { class: 'names' }), switches = el('div', { class: 'switches' });
    for (const layer of block.layers) {
        const group = svg('g', { class: `layer ${layer.layer}` });
        layer.shapes.forEach((shape, i) => {
            group.append(svg('path', { d: path(layer.layer, shape), 'vector-effect': 'non-scaling-stroke' }));
            const label = layer.labels[i];
            if (!label) return;
            const ys = shape.filter((_, k) => k % 2 === 1), xs = shape.filter((_, k) => k % 2 === 0);
            const text = svg('text', { x: (Math.min(...xs) + Math.max(...xs)) / 2, y: -Math.max(...ys), 'text-anchor': 'middle' });
            text.textContent = label;
            names.append(text);
        });
        picture.append(group);
        const box = el('input', { type: 'checkbox', checked: '' });
        box.addEventListener('change', () => {
            group.style.display = box.checked ? '' : 'none';
            if (layer.labels.length) names.style.display = group.style.display;
        });
        switches.append(el('label', {}, box, el('span', { class: `swatch ${layer.layer}` }), layer.name));
    }
    picture.append(names);

    const bar = el('div', { class: 'scale' }), readout = el('output', { class: 'readout' });
    const pixelsPerMetre = () => Math.min(picture.clientWidth / view.width, picture.clientHeight / view.height) || 1;
    const show = () => {
        picture.setAttribute('viewBox', `${view.x} ${view.y} ${view.width} ${view.height}`);
        const scale = pixelsPerMetre(), length = roundLength(160 / scale);
        bar.style.width = `${length * scale}px`;
        bar.textContent = `${length} m`;
        names.style.fontSize = `${11 / scale}px`;
    };
    const zoom = (factor: number, cx = view.x + view.width / 2, cy = view.y + view.height / 2) => {
        const width = Math.min(Math.max(view.width * factor, whole.width / 200), 2 * whole.width), real = width / view.width;
        view = { x: cx - (cx - view.x) * real, y: cy - (cy - view.y) * real, width, height: view.height * real };
        show();
    };
    const pan = (dx: number, dy: number) => {
        view = { ...view, x: view.x + dx * view.width, y: view.y + dy * view.height };
        show();
    };
    const reset = () => {
        view = { ...whole };
        show();
    };
    const place = (event: MouseEvent): [number, number] => {
        const at = new DOMPoint(event.clientX, event.clientY).matrixTransform(picture.getScreenCTM()!.inverse());
        return [at.x, at.y];
    };
    picture.addEventListener('wheel', (event) => {
        if (!event.ctrlKey && document.activeElement !== frame) return;  // the page scrolls on
        event.preventDefault();
        zoom(event.deltaY > 0 ? 1.2 : 1 / 1.2, ...place(event));
    }, { passive: false });
    picture.addEventListener('pointermove', (event) => {
        const [x, y] = place(event);
        readout.textContent = `${fixed(x, 1)}, ${fixed(-y, 1)} m`;
        if (event.buttons & 1) pan(-event.movementX / pixelsPerMetre() / view.width, -event.movementY / pixelsPerMetre() / view.height);
    });
    const frame = el('div', { class: 'plan', tabindex: '0', role: 'group', id: `plan-${block.name}`, 'aria-label': `${block.title}: arrows move, plus and minus zoom, 0 shows all` });
    frame.addEventListener('keydown', (event) => {
        const moves: Record<string, () => void> = {
            ArrowLeft: () => pan(-0.1, 0), ArrowRight: () => pan(0.1, 0), ArrowUp: () => pan(0, -0.1), ArrowDown: () => pan(0, 0.1),
            '+': () => zoom(1 / 1.3), '=': () => zoom(1 / 1.3), '-': () => zoom(1.3), '0': reset, Escape: reset,
        };
        if (event.target !== frame || !moves[event.key]) return;
        event.preventDefault();
        moves[event.key]();
    });
    const button = (text: string, title: string, act: () => void) => {
        const it = el('button', { type: 'button', title, 'aria-label': title }, text);
        it.addEventListener('click', act);
        return it;
    };
    frame.append(picture, bar, readout, el('div', { class: 'zoom' }, button('+', 'Closer', () => zoom(1 / 1.3)), button('−', 'Farther', () => zoom(1.3)), button('⤢', 'Show all', reset)));
    if (block.north) {
        const angle = (Math.atan2(block.north[0], block.north[1]) * 180) / Math.PI;
        frame.append(svg('svg', { class: 'north', viewBox: '-20 -24 40 48', role: 'img', 'aria-label': `North is ${fixed(angle, 0)} degrees clockwise from up` },
            svg('g', { transform: `rotate(${angle})` }, svg('path', { d: 'M0-14 7 10 0 5-7 10Z' }), Object.assign(svg('text', { y: -15, 'text-anchor': 'middle' }), { textContent: 'N' }))));
    }
    const aspect = Math.min(Math.max(whole.height / whole.width, 0.3), 0.85);
    picture.style.aspectRatio = `1 / ${aspect}`;
    new ResizeObserver(show).observe(picture);
    return el('figure', {}, el('figcaption', {}, `${block.title} (right: ${block.across}; up: ${block.up})`), frame, switches);
}
