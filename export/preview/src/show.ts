// The show as trajectories.bin tells it (docs/formats/trajectories-bin.md), with 4-byte scalars, and its evaluation.
// Show frame: x right, y away from the audience, z up; metres; seconds.

export type Act = {
    name: string;
    role: 'take-off' | 'transit' | 'hold' | 'landing';
    start: number;
    duration: number;
    motion:
        | { kind: 'hold'; at: Float32Array }
        | { kind: 'straight'; profile: Float32Array; from: Float32Array; to: Float32Array }
        | { kind: 'lattice'; rows: number; points: Float32Array };
};
export type LightTrack = { times: Float64Array; fades: Uint8Array; colors: Float32Array };
export type Keyframe = { name: string; from: number; to: number };
export type Obstacle = { name: string; base: number; height: number; outline: number[][] };
export type Show = {
    title: string;
    hash: string;
    certified: boolean;
    drones: number;
    duration: number;
    minSeparation: number;
    geofence: number[][];
    audience: number[][][];
    obstacles: Obstacle[];
    pads: Float32Array;
    acts: Act[];
    lights: LightTrack[];
    cues: { time: number; name: string }[];
    keyframes: Keyframe[];
};

const roles = ['take-off', 'transit', 'hold', 'landing'] as const;

class Cursor {
    private at = 0;
    private readonly view: DataView;
    private readonly decoder = new TextDecoder();
    constructor(private readonly bytes: Uint8Array) {
        this.view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
    }
    skip(count: number): void { this.at += count; }
    u32(): number { this.at += 4; return this.view.getUint32(this.at - 4, true); }
    i32(): number { this.at += 4; return this.view.getInt32(this.at - 4, true); }
    f32(): number { this.at += 4; return this.view.getFloat32(this.at - 4, true); }
    f64(): number { this.at += 8; return this.view.getFloat64(this.at - 8, true); }
    seconds(): number { return this.i32() / 1000; }
    floats(count: number): Float32Array {
        const values = new Float32Array(this.bytes.buffer, this.bytes.byteOffset + this.at, count);
        this.at += 4 * count;
        return values;
    }
    raw(count: number): Uint8Array { this.at += count; return this.bytes.subarray(this.at - count, this.at); }
    text(): string {
        const length = this.u32();
        const text = this.decoder.decode(this.raw(length));
        this.skip((4 - (length % 4)) % 4);
        return text;
    }
    list<T>(read: () => T): T[] { return Array.from({ length: this.u32() }, read); }
    polygon(): number[][] { return this.list(() => [this.f64(), this.f64()]); }
}

function readObstacle(c: Cursor): Obstacle {
    const name = c.text(), kind = c.u32(), base = c.f64(), height = c.f64();
    if (kind === 1) return { name, base, height, outline: c.polygon() };
    const x = c.f64(), y = c.f64(), radius = c.f64();
    const corner = (i: number) => [x + radius * Math.cos((i * Math.PI) / 16), y + radius * Math.sin((i * Math.PI) / 16)];
    return { name, base, height, outline: Array.from({ length: 32 }, (_, i) => corner(i)) };
}

function readAct(c: Cursor, n: number): Act {
    const name = c.text(), role = roles[c.u32()];
    c.skip(4); // timing
    const start = c.seconds(), duration = c.seconds(), kind = c.u32();
    if (kind === 0) return { name, role, start, duration, motion: { kind: 'hold', at: c.floats(3 * n) } };
    const rows = c.u32();
    if (kind === 1) {
        const profile = c.floats(rows), from = c.floats(3 * n), to = c.floats(3 * n);
        return { name, role, start, duration, motion: { kind: 'straight', profile, from, to } };
    }
    return { name, role, start, duration, motion: { kind: 'lattice', rows, points: c.floats(3 * n * rows) } };
}

function readLights(c: Cursor): LightTrack {
    const count = c.u32();
    const track = { times: new Float64Array(count), fades: new Uint8Array(count), colors: new Float32Array(3 * count) };
    for (let k = 0; k < count; ++k) {
        track.times[k] = c.seconds();
        track.fades[k] = c.u32();
        track.colors.set(c.floats(3), 3 * k);
    }
    c.skip(8 * c.u32());  // yaw
    c.skip(12 * c.u32()); // payload events
    return track;
}

/** Parses the bytes of a trajectories.bin with 4-byte scalars. Throws with a sentence for people when it is something else. */
export function parseShow(bytes: Uint8Array): Show {
    const c = new Cursor(bytes);
    const magic = new TextDecoder().decode(c.raw(8)), version = c.u32(), scalar = c.u32();
    if (magic !== 'AEROGRAM' || version !== 1 || scalar !== 4) throw new Error('this page holds no show that it can read');
    const certified = (c.u32() & 1) === 1;
    c.skip(12);
    const hash = Array.from(c.raw(32), (b) => b.toString(16).padStart(2, '0')).join('');
    c.skip(8);
    const title = c.text(), drones = c.u32();
    c.skip(4 * 8 + 4 + 8); // origin, undulation
    const minSeparation = c.f64();
    c.skip(10 * 8 + 8); // other limits, endurance
    const geofence = c.polygon(), audience = c.list(() => c.polygon()), obstacles = c.list(() => readObstacle(c));
    const pads = c.floats(3 * drones), acts = c.list(() => readAct(c, drones));
    const lights = Array.from({ length: drones }, () => readLights(c));
    const cues = c.list(() => ({ time: c.seconds(), name: c.text() }));
    const keyframes = c.list(() => ({ name: c.text(), from: c.seconds(), to: c.seconds() }));
    const last = acts[acts.length - 1];
    return { title, hash, certified, drones, duration: last.start + last.duration, minSeparation, geofence, audience, obstacles,
             pads, acts, lights, cues, keyframes };
}

export function actAt(show: Show, t: number): number {
    let index = 0;
    while (index + 1 < show.acts.length && show.acts[index + 1].start <= t) ++index;
    return index;
}

function weights(u: number): [number, number, number, number] {
    const v = 1 - u;
    return [(v * v * v) / 6, (3 * u * u * u - 6 * u * u + 4) / 6, (3 * v * v * v - 6 * v * v + 4) / 6, (u * u * u) / 6];
}

/** Positions of all drones at show time t (clamped), x y z one after another, into `out`. */
export function positionsAt(show: Show, t: number, out: Float32Array): void {
    const act = show.acts[actAt(show, t)], motion = act.motion;
    if (motion.kind === 'hold') {
        out.set(motion.at);
        return;
    }
    const rows = motion.kind === 'straight' ? motion.profile.length : motion.rows;
    const knots = Math.min(Math.max(((t - act.start) / act.duration) * (rows - 3), 0), rows - 3);
    const m = Math.min(Math.floor(knots), rows - 4), w = weights(knots - m);
    if (motion.kind === 'straight') {
        const p = motion.profile, s = w[0] * p[m] + w[1] * p[m + 1] + w[2] * p[m + 2] + w[3] * p[m + 3];
        for (let i = 0; i < out.length; ++i) out[i] = motion.from[i] + s * (motion.to[i] - motion.from[i]);
        return;
    }
    const p = motion.points, row = out.length;
    for (let i = 0, q = m * row; i < row; ++i, ++q) {
        out[i] = w[0] * p[q] + w[1] * p[q + row] + w[2] * p[q + 2 * row] + w[3] * p[q + 3 * row];
    }
}

/** Index of the last of ascending times that is <= t; -1 when there is none. */
function lastNotAfter(times: Float64Array, t: number): number {
    let low = 0, high = times.length;
    while (low < high) {
        const middle = (low + high) >> 1;
        if (times[middle] <= t) low = middle + 1;
        else high = middle;
    }
    return low - 1;
}

/** Lamp colours of all drones at show time t: linear light in 0..1, into `out`. */
export function colorsAt(show: Show, t: number, out: Float32Array): void {
    show.lights.forEach((track, drone) => {
        const k = lastNotAfter(track.times, t);
        for (let c = 0; c < 3; ++c) {
            let value = k < 0 ? 0 : track.colors[3 * k + c];
            if (k >= 0 && track.fades[k] && k + 1 < track.times.length) {
                const share = (t - track.times[k]) / (track.times[k + 1] - track.times[k]);
                value += share * (track.colors[3 * k + 3 + c] - value);
            }
            out[3 * drone + c] = value;
        }
    });
}
