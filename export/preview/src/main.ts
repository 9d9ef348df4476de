// The player: clock, controls, keys. The address may say where to begin: #t=34.5&camera=2&labels=1&trails=1&speed=2&play=1
import { type Show, actAt, parseShow } from './show';
import { Scene, viewNames } from './scene';
import { Timeline } from './timeline';

const speeds = [0.25, 0.5, 1, 2, 4, 8];
const labelledDrones = 500;

function element<T extends HTMLElement>(id: string): T {
    return document.getElementById(id) as T;
}

function embeddedBytes(): Uint8Array {
    const text = element('show').textContent!.trim(), raw = atob(text), bytes = new Uint8Array(raw.length);
    for (let i = 0; i < raw.length; ++i) bytes[i] = raw.charCodeAt(i);
    return bytes;
}

function clockText(t: number): string {
    const minutes = Math.floor(t / 60), seconds = (t - 60 * minutes).toFixed(1).padStart(4, '0');
    return `${minutes}:${seconds}`;
}

class Player {
    private t = 0;
    private speed = 1;
    private playing = false;
    private before = 0;
    private readonly scene: Scene;
    private readonly timeline: Timeline;
    private readonly names = element<HTMLCanvasElement>('names');
    private readonly labels = element<HTMLInputElement>('labels');
    private readonly trails = element<HTMLInputElement>('trails');
    private readonly speedBox = element<HTMLSelectElement>('speed');

    constructor(private readonly show: Show) {
        this.scene = new Scene(show, element<HTMLCanvasElement>('sky'));
        this.timeline = new Timeline(show, element<HTMLCanvasElement>('timeline'), (t) => this.seek(t));
        element('title').textContent = document.title = show.title;
        element('facts').textContent =
            `${show.drones} drones · ${clockText(show.duration)} · show hash ${show.hash.slice(0, 12)}…`;
        const verdict = element('verdict');
        verdict.textContent = show.certified
            ? `certified: never closer than ${show.minSeparation.toFixed(2)} m` : 'NOT CERTIFIED: do not fly';
        verdict.className = show.certified ? 'good' : 'bad';
        this.makeControls();
        this.readAddress();
        window.addEventListener('resize', () => this.resize());
        window.addEventListener('hashchange', () => this.readAddress());
        window.addEventListener('keydown', (event) => this.key(event));
        this.resize();
        requestAnimationFrame((now) => this.frame(now));
    }

    private makeControls(): void {
        element('play').onclick = () => this.play(!this.playing);
        element('back').onclick = () => this.seek(this.t - 5);
        element('forward').onclick = () => this.seek(this.t + 5);
        element('help-button').onclick = () => element<HTMLDialogElement>('help').showModal();
        for (const speed of speeds) this.speedBox.add(new Option(`${speed}×`, String(speed), speed === 1, speed === 1));
        this.speedBox.onchange = () => { this.speed = Number(this.speedBox.value); };
        this.trails.onchange = () => { this.scene.trailsShown = this.trails.checked; };
        viewNames.forEach((name, view) => {
            const button = document.createElement('button');
            button.textContent = name;
            button.title = `Camera ${view + 1}`;
            button.onclick = () => this.scene.look(view);
            element('views').append(button);
        });
    }

    private readAddress(): void {
        const wish = new URLSearchParams(location.hash.slice(1));
        if (wish.has('camera')) this.scene.look(Math.min(4, Math.max(0, Number(wish.get('camera')) - 1 || 0)));
        if (wish.has('speed')) this.setSpeed(Number(wish.get('speed')));
        this.labels.checked = wish.get('labels') === '1' || this.labels.checked;
        this.trails.checked = wish.get('trails') === '1' || this.trails.checked;
        this.scene.trailsShown = this.trails.checked;
        if (wish.has('t')) this.seek(Number(wish.get('t')) || 0);
        if (wish.has('play')) this.play(wish.get('play') === '1');
    }

    private resize(): void {
        const width = window.innerWidth, height = window.innerHeight;
        this.scene.resize(width, height);
        this.names.width = width * window.devicePixelRatio;
        this.names.height = height * window.devicePixelRatio;
    }

    private play(on: boolean): void {
        if (on && this.t >= this.show.duration) this.t = 0;
        this.playing = on;
        element('play').textContent = on ? '❚❚' : '▶';
    }

    private seek(t: number): void { this.t = Math.min(Math.max(t, 0), this.show.duration); }

    private setSpeed(speed: number): void {
        this.speed = speeds.includes(speed) ? speed : 1;
        this.speedBox.value = String(this.speed);
    }

    private jump(direction: number): void {
        const marks = this.show.keyframes.map((k) => k.from).concat(0, this.show.duration).sort((a, b) => a - b);
        const next = direction > 0 ? marks.find((m) => m > this.t + 0.01) : marks.reverse().find((m) => m < this.t - 0.01);
        if (next !== undefined) this.seek(next);
    }

    private key(event: KeyboardEvent): void {
        if (event.ctrlKey || event.altKey || event.metaKey || element<HTMLDialogElement>('help').open) return;
        if (event.target instanceof HTMLSelectElement) return;
        const step = event.shiftKey ? 1 : 0.1, faster = speeds.indexOf(this.speed);
        const actions: Record<string, () => void> = {
            ' ': () => this.play(!this.playing),
            k: () => this.play(!this.playing),
            j: () => this.seek(this.t - 5),
            l: () => this.seek(this.t + 5),
            arrowleft: () => this.seek(this.t - step),
            arrowright: () => this.seek(this.t + step),
            home: () => this.seek(0),
            end: () => this.seek(this.show.duration),
            '[': () => this.jump(-1),
            ']': () => this.jump(1),
            '-': () => this.setSpeed(speeds[Math.max(0, faster - 1)]),
            '+': () => this.setSpeed(speeds[Math.min(speeds.length - 1, faster + 1)]),
            '=': () => this.setSpeed(speeds[Math.min(speeds.length - 1, faster + 1)]),
            n: () => { this.labels.checked = !this.labels.checked; },
            t: () => this.trails.click(),
            '?': () => element<HTMLDialogElement>('help').showModal(),
        };
        for (let view = 0; view < viewNames.length; ++view) actions[String(view + 1)] = () => this.scene.look(view);
        const action = actions[event.key.toLowerCase()];
        if (!action) return;
        event.preventDefault();
        if (event.target instanceof HTMLButtonElement) event.target.blur();
        action();
    }

    private frame(now: number): void {
        if (this.playing) {
            this.t += ((now - this.before) / 1000) * this.speed;
            if (this.t >= this.show.duration) {
                this.t = this.show.duration;
                this.play(false);
            }
        }
        this.before = now;
        this.scene.draw(this.t);
        this.timeline.draw(this.t);
        element('clock').textContent = `${clockText(this.t)} / ${clockText(this.show.duration)}`;
        element('moment').textContent = this.show.acts[actAt(this.show, this.t)].name;
        this.drawNames();
        requestAnimationFrame((next) => this.frame(next));
    }

    private drawNames(): void {
        const pen = this.names.getContext('2d')!, width = window.innerWidth, height = window.innerHeight;
        pen.setTransform(window.devicePixelRatio, 0, 0, window.devicePixelRatio, 0, 0);
        pen.clearRect(0, 0, width, height);
        if (!this.labels.checked) return;
        pen.font = '12px system-ui, sans-serif';
        pen.fillStyle = '#cfe0ff';
        for (let i = 0; i < Math.min(this.show.drones, labelledDrones); ++i) {
            const at = this.scene.onScreen(i, width, height);
            if (at) pen.fillText(String(i + 1), at[0] + 7, at[1] - 7);
        }
    }
}

try {
    new Player(parseShow(embeddedBytes()));
} catch (error) {
    document.body.textContent = `Aerogram cannot show this page: ${error instanceof Error ? error.message : String(error)}`;
}
