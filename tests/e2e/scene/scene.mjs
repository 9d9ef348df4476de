// What Khronos' validator and three.js say of a GLB file, as one line of JSON.
//   node scene.mjs show.glb TIME_S...
import { readFileSync } from "node:fs";
import { AnimationMixer } from "three";
import { GLTFLoader } from "three/addons/loaders/GLTFLoader.js";
import validator from "gltf-validator";

const [file, ...times] = process.argv.slice(2);
const bytes = new Uint8Array(readFileSync(file));
const { issues } = await validator.validateBytes(bytes, { maxIssues: 100 });

globalThis.self ??= globalThis; // the loader asks a browser's global for its URL
const gltf = await new GLTFLoader().parseAsync(bytes.slice().buffer, "");
const mixer = new AnimationMixer(gltf.scene);
for (const clip of gltf.animations) mixer.clipAction(clip).play();
const drones = gltf.scene.children;
const places = times.map((time) => {
    mixer.setTime(Number(time));
    gltf.scene.updateMatrixWorld(true);
    return drones.map((drone) => drone.matrixWorld.elements.slice(12, 15));
});
const names = drones.map((drone) => drone.name);
const colors = drones.map((drone) => drone.material.emissive.toArray());
console.log(JSON.stringify({ issues, names, colors, places, facts: gltf.asset.extras.aerogram }));
