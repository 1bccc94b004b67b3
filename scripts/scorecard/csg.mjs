// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Engines from npm for the score card: csg.mjs manifold|three-bvh-csg|jscad OPERATION OUTPUT.off INPUT.off ...
// setup.sh copies this file beside the packages. It prints the processor seconds without those of files.
import { readFileSync, writeFileSync } from "node:fs";

const [method, operation, output, ...inputs] = process.argv.slice(2);

const cpu = () => { const { user, system } = process.cpuUsage(); return (user + system) / 1e6; };
let begin = 0, end = 0;

function read(path) {
    const words = readFileSync(path, "ascii").split(/\s+/);
    const vertices = Number(words[1]), faces = Number(words[2]);
    const points = words.slice(4, 4 + 3 * vertices).map(Number);
    const rest = words.slice(4 + 3 * vertices);
    const corners = [];
    for (let k = 0; k < faces; ++k) corners.push(...rest.slice(4 * k + 1, 4 * k + 4).map(Number));
    return { points, corners };
}

/// Writes polygons, each a list of corners; corners that are equal become one point.
function write(polygons) {
    const numbers = new Map(), lines = [];
    for (const polygon of polygons) {
        const face = polygon.map((p) => {
            const key = Array.from(p, (x) => x + 0).join(" ");
            if (!numbers.has(key)) numbers.set(key, numbers.size);
            return numbers.get(key);
        });
        lines.push(`${face.length} ${face.join(" ")}`);
    }
    writeFileSync(output, [`OFF\n${numbers.size} ${lines.length} 0`, ...numbers.keys(), ...lines, ""].join("\n"));
}

/// Triangles of points, three numbers each, whose corners are listed one after the other.
function triangles(points, corners) {
    const corner = (k) => Array.from(points.slice(3 * k, 3 * k + 3));
    return Array.from({ length: corners.length / 3 }, (_, t) => Array.from(corners.slice(3 * t, 3 * t + 3), corner));
}

const engines = {
    async manifold() {
        const wasm = await (await import("manifold-3d")).default();
        wasm.setup();
        const given = inputs.map(read);
        begin = cpu();
        const bodies = given.map(({ points, corners }) => new wasm.Manifold(new wasm.Mesh(
            { numProp: 3, vertProperties: Float32Array.from(points), triVerts: Uint32Array.from(corners) })));
        const made = bodies.reduce((a, b) => wasm.Manifold[operation](a, b)).getMesh();
        end = cpu();
        write(triangles(made.vertProperties, made.triVerts));
    },
    async "three-bvh-csg"() {
        const three = await import("three");
        const { Brush, Evaluator, ADDITION, SUBTRACTION, INTERSECTION } = await import("three-bvh-csg");
        const given = inputs.map(read);
        begin = cpu();
        const bodies = given.map(({ points, corners }) => {
            const geometry = new three.BufferGeometry();
            geometry.setAttribute("position", new three.BufferAttribute(Float32Array.from(points), 3));
            geometry.setIndex(corners);
            const brush = new Brush(geometry);
            brush.updateMatrixWorld();
            return brush;
        });
        const evaluator = new Evaluator();
        evaluator.attributes = ["position"];
        evaluator.useGroups = false;
        const rule = { union: ADDITION, intersection: INTERSECTION, difference: SUBTRACTION }[operation];
        const made = bodies.reduce((a, b) => evaluator.evaluate(a, b, rule)).geometry;
        end = cpu();
        const { start, count } = made.drawRange, points = made.attributes.position.array;
        const all = made.index ? made.index.array : [...Array(points.length / 3).keys()];
        write(triangles(points, all.slice(start, Number.isFinite(count) ? start + count : undefined)));
    },
    async jscad() {
        const { booleans, geometries, modifiers } = (await import("@jscad/modeling")).default;
        const given = inputs.map(read);
        begin = cpu();
        const bodies = given.map(({ points, corners }) => geometries.geom3.create(
            triangles(points, corners).map((t) => geometries.poly3.create(t))));
        const rule = { union: "union", intersection: "intersect", difference: "subtract" }[operation];
        const made = modifiers.generalize({ snap: true, triangulate: true }, booleans[rule](...bodies));
        end = cpu();
        write(geometries.geom3.toPolygons(made).map((p) => p.vertices));
    },
};

await engines[method]();
console.log(`operation: ${end - begin} s`);
