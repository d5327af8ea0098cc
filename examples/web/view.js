// Two models in one canvas, by three.js: the original left of a divider, the simplified model right of it.
import { Box3, Color, PerspectiveCamera, PMREMGenerator, Scene, Sphere, WebGLRenderer } from "three";
import { OrbitControls } from "three/addons/controls/OrbitControls.js";
import { RoomEnvironment } from "three/addons/environments/RoomEnvironment.js";
import { GLTFLoader } from "three/addons/loaders/GLTFLoader.js";

export class View {
    #models = [null, null];
    #divider = 0.5;
    #wireframe = false;
    #scene = new Scene();
    #camera = new PerspectiveCamera(35);
    #renderer;
    #controls;

    constructor(canvas) {
        this.#renderer = new WebGLRenderer({ canvas, antialias: true });
        this.#renderer.setScissorTest(true);
        this.#scene.background = new Color(0x808890);
        this.#scene.environment = new PMREMGenerator(this.#renderer).fromScene(new RoomEnvironment(), 0.04).texture;
        this.#controls = new OrbitControls(this.#camera, canvas);
        this.#controls.addEventListener("change", () => this.#draw());
        new ResizeObserver(() => this.#resize(canvas)).observe(canvas);
    }

    /** Shows a GLB file left (0) or right (1) of the divider, or nothing. */
    async show(side, glb) {
        const model = glb && (await new GLTFLoader().parseAsync(glb.slice().buffer, "")).scene;
        if (this.#models[side]) this.#remove(this.#models[side]);
        this.#models[side] = model;
        if (model) this.#scene.add(model);
        if (model && side === 0) this.#frame(model);
        this.wireframe = this.#wireframe;
    }

    /** The share of the width that has the original. */
    set divider(value) {
        this.#divider = value;
        this.#draw();
    }

    set wireframe(value) {
        this.#wireframe = value;
        this.#scene.traverse(({ material }) => material && (material.wireframe = value));
        this.#draw();
    }

    #frame(model) {
        const { center, radius } = new Box3().setFromObject(model).getBoundingSphere(new Sphere());
        const distance = (0.85 * radius) / Math.sin((this.#camera.fov / 2) * (Math.PI / 180));
        this.#camera.position.set(0.5, 0.35, 0.8).setLength(distance).add(center);
        Object.assign(this.#camera, { near: distance / 100, far: 10 * distance });
        this.#camera.updateProjectionMatrix();
        this.#controls.target.copy(center);
        this.#controls.update();
    }

    #remove(model) {
        this.#scene.remove(model);
        model.traverse(({ geometry, material }) => {
            geometry?.dispose();
            for (const value of Object.values(material ?? {})) if (value?.isTexture) value.dispose();
            material?.dispose();
        });
    }

    #resize({ clientWidth, clientHeight }) {
        this.#renderer.setPixelRatio(window.devicePixelRatio);
        this.#renderer.setSize(clientWidth, clientHeight, false);
        this.#camera.aspect = clientWidth / clientHeight;
        this.#camera.updateProjectionMatrix();
        this.#draw();
    }

    #draw() {
        const { clientWidth, clientHeight } = this.#renderer.domElement;
        const edge = this.#models[1] ? Math.round(this.#divider * clientWidth) : clientWidth;
        for (const [side, begin, end] of [[0, 0, edge], [1, edge + 1, clientWidth]]) {
            if (begin >= end) continue;
            this.#models.forEach((model, i) => model && (model.visible = i === side));
            this.#renderer.setScissor(begin, 0, end - begin, clientHeight);
            this.#renderer.render(this.#scene, this.#camera);
        }
    }
}
