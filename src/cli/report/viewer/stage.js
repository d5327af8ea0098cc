// Draws both models with one shared camera on one canvas, which lies behind the frames of both models.
import {
  NeutralToneMapping, PerspectiveCamera, PMREMGenerator, Quaternion, Scene, Vector3, WebGLRenderer,
} from 'three';
import { OrbitControls } from 'three/addons/controls/OrbitControls.js';
import { RoomEnvironment } from 'three/addons/environments/RoomEnvironment.js';

const fieldOfView = 30; // degrees
const initialDirection = new Vector3(0.34, 0.16, 0.93).normalize(); // that of the first picture of the page
const clipDistance = 1.5; // distance of the clipping planes from the target; the models' diagonal is about 1

function moveByKeys(canvas, controls) {
  const turn = Math.PI / 36, zoom = 0.9;
  const moves = {
    ArrowLeft: () => controls.rotateLeft(turn),
    ArrowRight: () => controls.rotateLeft(-turn),
    ArrowUp: () => controls.rotateUp(turn),
    ArrowDown: () => controls.rotateUp(-turn),
    '+': () => controls.dollyIn(zoom),
    '-': () => controls.dollyOut(zoom),
  };
  canvas.addEventListener('keydown', (event) => {
    if (!moves[event.key] || event.ctrlKey || event.altKey || event.metaKey) return;
    event.preventDefault();
    moves[event.key]();
  });
}

/// Creates the renderer. \param frames  elements above the canvas, one for each model \param up  axis: y or z
export function makeStage(canvas, frames, up) {
  const renderer = new WebGLRenderer({ canvas, antialias: true, alpha: true });
  renderer.toneMapping = NeutralToneMapping;
  renderer.setScissorTest(true);
  const generator = new PMREMGenerator(renderer);
  const environment = generator.fromScene(new RoomEnvironment(), 0.04).texture;
  const scenes = frames.map(() => Object.assign(new Scene(), { environment }));
  const camera = new PerspectiveCamera(fieldOfView);
  const turn = new Quaternion().setFromUnitVectors(camera.up, up === 'z' ? new Vector3(0, 0, 1) : camera.up);
  camera.up.applyQuaternion(turn);
  const controls = new OrbitControls(camera, canvas);
  let models = [], isDrawScheduled = false;

  function drawFrame(frame, scene) {
    const outer = canvas.getBoundingClientRect(), inner = frame.getBoundingClientRect();
    const box = [inner.left - outer.left, outer.bottom - inner.bottom, inner.width, inner.height];
    renderer.setViewport(...box);
    renderer.setScissor(...box);
    camera.aspect = inner.width / inner.height;
    camera.updateProjectionMatrix();
    renderer.render(scene, camera);
  }
  function drawNow() {
    isDrawScheduled = false;
    const { clientWidth, clientHeight } = canvas;
    if (!clientWidth || !clientHeight) return;
    renderer.setPixelRatio(window.devicePixelRatio);
    renderer.setSize(clientWidth, clientHeight, false);
    const distance = camera.position.distanceTo(controls.target);
    camera.near = Math.max(distance - clipDistance, distance / 500);
    camera.far = distance + clipDistance;
    frames.forEach((frame, i) => drawFrame(frame, scenes[i]));
  }
  function draw() {
    if (!isDrawScheduled) requestAnimationFrame(drawNow);
    isDrawScheduled = true;
  }
  function setModels(newModels) {
    models = newModels;
    models.forEach(({ look, error, edges }, i) => scenes[i].add(look, error, edges));
    draw();
  }
  function show({ wireframe, error }) {
    for (const model of models) {
      model.look.visible = !error;
      model.error.visible = error;
      model.edges.visible = wireframe;
    }
    draw();
  }

  const shape = frames[0].getBoundingClientRect();
  const narrow = Math.min(1, shape.width / shape.height);
  camera.position.copy(initialDirection).applyQuaternion(turn).multiplyScalar(0.47 / Math.sin((fieldOfView / 360) * Math.PI) / narrow);
  controls.update();
  controls.saveState();
  controls.addEventListener('change', draw);
  moveByKeys(canvas, controls);
  new ResizeObserver(draw).observe(canvas);
  return { setModels, show, draw, reset: () => controls.reset() };
}
