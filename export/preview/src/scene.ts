// What is seen: the night, the ground with pads, fence, audience and obstacles, the drones as lights, their trails.
import * as THREE from 'three';
import { OrbitControls } from 'three/examples/jsm/controls/OrbitControls.js';
import { type Show, colorsAt, positionsAt } from './show';

const trailSeconds = 4, trailSteps = 32, trailDrones = 2000;
export const viewNames = ['audience', 'front', 'above', 'side', 'corner'] as const;

/** What the audience came to see: where the formations stand or are passed. */
function formationBounds(show: Show): THREE.Box3 {
    const box = new THREE.Box3(), p = new Float32Array(3 * show.drones), at = new THREE.Vector3();
    for (const keyframe of show.keyframes) {
        positionsAt(show, keyframe.from, p);
        for (let i = 0; i < p.length; i += 3) box.expandByPoint(at.set(p[i], p[i + 1], p[i + 2]));
    }
    return box;
}

function outline(points: number[][], z: number, color: number): THREE.LineLoop {
    const geometry = new THREE.BufferGeometry().setFromPoints(points.map(([x, y]) => new THREE.Vector3(x, y, z)));
    return new THREE.LineLoop(geometry, new THREE.LineBasicMaterial({ color }));
}

function flat(points: number[][], color: number, opacity: number): THREE.Mesh {
    const shape = new THREE.Shape(points.map(([x, y]) => new THREE.Vector2(x, y)));
    const material = new THREE.MeshBasicMaterial({ color, opacity, transparent: true, side: THREE.DoubleSide, depthWrite: false });
    return new THREE.Mesh(new THREE.ShapeGeometry(shape), material);
}

function ground(show: Show, extent: number): THREE.Group {
    const group = new THREE.Group();
    const step = Math.pow(10, Math.round(Math.log10(extent / 12))), cells = 2 * Math.ceil(extent / step);
    const grid = new THREE.GridHelper(cells * step, cells, 0x22304a, 0x131c2e);
    grid.rotation.x = Math.PI / 2;
    group.add(grid);
    const pads = new THREE.BufferGeometry();
    pads.setAttribute('position', new THREE.BufferAttribute(show.pads, 3));
    group.add(new THREE.Points(pads, new THREE.PointsMaterial({ color: 0x3d5170, size: 3, sizeAttenuation: false })));
    if (show.geofence.length > 0) group.add(outline(show.geofence, 0.05, 0xd65a4a));
    for (const area of show.audience) {
        group.add(flat(area, 0x4a78d6, 0.25), outline(area, 0.05, 0x4a78d6));
    }
    for (const obstacle of show.obstacles) {
        const shape = new THREE.Shape(obstacle.outline.map(([x, y]) => new THREE.Vector2(x, y)));
        const solid = new THREE.ExtrudeGeometry(shape, { depth: obstacle.height, bevelEnabled: false });
        const mesh = new THREE.Mesh(solid, new THREE.MeshBasicMaterial({ color: 0x55607a, transparent: true, opacity: 0.5 }));
        mesh.position.z = obstacle.base;
        group.add(mesh);
    }
    return group;
}

/** Lamps as round points with a halo: size in pixels never below 3, so that a far show is still read. */
function lampMaterial(): THREE.ShaderMaterial {
    return new THREE.ShaderMaterial({
        transparent: true,
        depthWrite: false,
        blending: THREE.AdditiveBlending,
        uniforms: { pixels: { value: 1 } },
        vertexShader: `
            attribute vec3 lamp;
            varying vec3 shade;
            uniform float pixels;
            void main() {
                shade = lamp + vec3(0.03);
                vec4 eye = modelViewMatrix * vec4(position, 1.0);
                gl_Position = projectionMatrix * eye;
                gl_PointSize = max(3.0, 1.6 * pixels / max(0.1, -eye.z)) * 2.2;
            }`,
        fragmentShader: `
            varying vec3 shade;
            void main() {
                float r = length(gl_PointCoord - 0.5) * 2.0;
                float core = smoothstep(0.5, 0.3, r), halo = 0.28 * pow(max(0.0, 1.0 - r), 2.0);
                gl_FragColor = vec4(shade * (core + halo) + vec3(0.35 * core * max(shade.r, max(shade.g, shade.b))), 1.0);
                #include <colorspace_fragment>
            }`,
    });
}

export class Scene {
    readonly positions: Float32Array;
    private readonly colors: Float32Array;
    private readonly renderer: THREE.WebGLRenderer;
    private readonly camera = new THREE.PerspectiveCamera(45, 1, 0.1, 20000);
    private readonly controls: OrbitControls;
    private readonly scene = new THREE.Scene();
    private readonly lamps = new THREE.BufferGeometry();
    private readonly material = lampMaterial();
    private readonly trails = new THREE.BufferGeometry();
    private readonly trailLines: THREE.LineSegments;
    private readonly box: THREE.Box3;

    constructor(private readonly show: Show, canvas: HTMLCanvasElement) {
        this.renderer = new THREE.WebGLRenderer({ canvas, antialias: true });
        this.renderer.setClearColor(0x05080f);
        this.positions = new Float32Array(3 * show.drones);
        this.colors = new Float32Array(3 * show.drones);
        this.lamps.setAttribute('position', new THREE.BufferAttribute(this.positions, 3));
        this.lamps.setAttribute('lamp', new THREE.BufferAttribute(this.colors, 3));
        const points = new THREE.Points(this.lamps, this.material);
        points.frustumCulled = false;
        this.trailLines = new THREE.LineSegments(this.trails, new THREE.LineBasicMaterial({ vertexColors: true, transparent: true,
            blending: THREE.AdditiveBlending, depthWrite: false }));
        this.trailLines.frustumCulled = false;
        this.trailLines.visible = false;
        this.box = formationBounds(show);
        const extent = Math.max(...this.box.getSize(new THREE.Vector3()).toArray(), this.box.max.z, 20);
        this.scene.add(ground(show, 2 * extent), this.trailLines, points);
        this.camera.up.set(0, 0, 1);
        this.controls = new OrbitControls(this.camera, canvas);
        this.controls.maxPolarAngle = Math.PI / 2 - 0.002;
        this.controls.maxDistance = 40 * extent;
        this.look(0);
    }

    /** Camera preset: see viewNames. The audience sits before the show, eyes at 1.7 m. */
    look(view: number): void {
        const size = this.box.getSize(new THREE.Vector3()), center = this.box.getCenter(new THREE.Vector3());
        const reach = Math.max(size.x, size.z, 12) / Math.min(1, this.camera.aspect);
        const front = Math.min(this.box.min.y, ...Array.from({ length: this.show.drones }, (_, i) => this.show.pads[3 * i + 1]));
        const eyes = [
            new THREE.Vector3(center.x, front - 1.1 * Math.max(reach, this.box.max.z), 1.7),
            new THREE.Vector3(center.x, this.box.min.y - 2.2 * reach, center.z),
            new THREE.Vector3(center.x, center.y - 0.01, center.z + 2.2 * Math.max(reach, size.y)),
            new THREE.Vector3(center.x + 2.2 * Math.max(reach, size.y), center.y, center.z),
            new THREE.Vector3(center.x - 1.5 * reach, center.y - 1.8 * reach, center.z + 0.8 * reach),
        ];
        this.camera.position.copy(eyes[view]);
        this.controls.target.set(center.x, center.y, view === 0 ? 0.6 * this.box.max.z : center.z);
        this.controls.update();
    }

    set trailsShown(shown: boolean) { this.trailLines.visible = shown && this.show.drones <= trailDrones; }

    resize(width: number, height: number): void {
        this.renderer.setPixelRatio(window.devicePixelRatio);
        this.renderer.setSize(width, height, false);
        this.camera.aspect = width / height;
        this.camera.updateProjectionMatrix();
        const halfAngle = (this.camera.fov * Math.PI) / 360;
        this.material.uniforms.pixels.value = (0.15 * height * window.devicePixelRatio) / Math.tan(halfAngle);
    }

    draw(t: number): void {
        positionsAt(this.show, t, this.positions);
        colorsAt(this.show, t, this.colors);
        this.lamps.attributes.position.needsUpdate = true;
        this.lamps.attributes.lamp.needsUpdate = true;
        if (this.trailLines.visible) this.layTrails(t);
        this.renderer.render(this.scene, this.camera);
    }

    /** Where drone i is on the screen, CSS pixels; null behind the camera. */
    onScreen(i: number, width: number, height: number): [number, number] | null {
        const p = new THREE.Vector3(this.positions[3 * i], this.positions[3 * i + 1], this.positions[3 * i + 2]).project(this.camera);
        return p.z > 1 ? null : [((p.x + 1) / 2) * width, ((1 - p.y) / 2) * height];
    }

    private layTrails(t: number): void {
        const n = this.show.drones, lines = new Float32Array(n * trailSteps * 6), shades = new Float32Array(n * trailSteps * 6);
        let newer = this.positions.slice();
        for (let step = 1; step <= trailSteps; ++step) {
            const older = new Float32Array(3 * n), fade = 0.5 * (1 - step / trailSteps);
            positionsAt(this.show, Math.max(0, t - (trailSeconds * step) / trailSteps), older);
            for (let i = 0; i < n; ++i) {
                const at = 6 * ((step - 1) * n + i);
                for (let c = 0; c < 3; ++c) {
                    lines[at + c] = newer[3 * i + c];
                    lines[at + 3 + c] = older[3 * i + c];
                    shades[at + c] = shades[at + 3 + c] = fade * (0.15 + this.colors[3 * i + c]);
                }
            }
            newer = older;
        }
        this.trails.setAttribute('position', new THREE.BufferAttribute(lines, 3));
        this.trails.setAttribute('color', new THREE.BufferAttribute(shades, 3));
    }
}
