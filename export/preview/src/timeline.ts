// The bar below: acts as bands, formations by name, cues as ticks, the moment as a line. Click or drag to go there.
import type { Show } from './show';

const bands = { 'take-off': '#2b4a3a', transit: '#1d2b45', hold: '#6b5320', landing: '#2b4a3a' } as const;

export class Timeline {
    constructor(private readonly show: Show, private readonly canvas: HTMLCanvasElement, seek: (t: number) => void) {
        const go = (event: PointerEvent) => {
            const box = canvas.getBoundingClientRect();
            seek(((event.clientX - box.left) / box.width) * show.duration);
        };
        canvas.addEventListener('pointerdown', (event) => {
            canvas.setPointerCapture(event.pointerId);
            go(event);
        });
        canvas.addEventListener('pointermove', (event) => {
            if (event.buttons & 1) go(event);
        });
        canvas.setAttribute('aria-valuemin', '0');
        canvas.setAttribute('aria-valuemax', show.duration.toFixed(1));
    }

    draw(t: number): void {
        const ratio = window.devicePixelRatio, width = this.canvas.clientWidth, height = this.canvas.clientHeight;
        if (this.canvas.width !== Math.round(width * ratio)) {
            this.canvas.width = Math.round(width * ratio);
            this.canvas.height = Math.round(height * ratio);
        }
        const pen = this.canvas.getContext('2d')!;
        pen.setTransform(ratio, 0, 0, ratio, 0, 0);
        const x = (time: number) => (time / this.show.duration) * width;
        for (const act of this.show.acts) {
            pen.fillStyle = bands[act.role];
            pen.fillRect(x(act.start), 0, Math.max(1, x(act.start + act.duration) - x(act.start) - 1), height);
        }
        pen.font = '13px system-ui, sans-serif';
        pen.textBaseline = 'middle';
        let free = 0;
        for (const keyframe of this.show.keyframes) {
            const label = pen.measureText(keyframe.name).width, at = (x(keyframe.from) + x(keyframe.to)) / 2 - label / 2;
            if (at < free) continue;
            pen.fillStyle = '#ffe3a3';
            pen.fillText(keyframe.name, at, height / 2);
            free = at + label + 6;
        }
        pen.fillStyle = '#7ec8ff';
        for (const cue of this.show.cues) pen.fillRect(x(cue.time), 0, 2, 8);
        pen.fillStyle = '#ffffff';
        pen.fillRect(x(t) - 1, 0, 2, height);
        this.canvas.setAttribute('aria-valuenow', t.toFixed(1));
    }
}
