// The 3D view of a page of `faqem report`: both models under one camera. The page holds the models as base64 GLB and
// says in #view-data how to colour errors; it is complete without this script.
import { makeErrorMaterial } from './error_material.js';
import { readModel } from './model.js';
import { makeStage } from './stage.js';

const byId = (id) => document.getElementById(id);

function connectControls(stage, errorMaterial, view) {
  const wireframe = byId('wireframe'), error = byId('error'), limit = byId('limit');
  const show = () => stage.show({ wireframe: wireframe.checked, error: error.checked });
  const colour = () => {
    // A share of the largest distance, squared: most distances are far smaller than the largest.
    const value = view.max_distance * limit.value ** 2;
    errorMaterial.uniforms.limit.value = value;
    byId('limit-value').textContent = `${(value * view.unit).toPrecision(3)} (${(100 * value).toPrecision(2)}%)`;
    stage.draw();
  };
  wireframe.addEventListener('change', show);
  error.addEventListener('change', () => {
    byId('scale').hidden = !error.checked;
    show();
  });
  limit.addEventListener('input', colour);
  byId('reset').addEventListener('click', stage.reset);
  limit.value = view.max_distance > 0 ? Math.sqrt(view.limit / view.max_distance) : 1;
  byId('scale').hidden = !error.checked; // a browser may remember the boxes
  colour();
  show();
}

async function start() {
  const view = JSON.parse(byId('view-data').textContent);
  const errorMaterial = makeErrorMaterial(view.ramp);
  const stage = makeStage(byId('canvas'), [byId('frame-a'), byId('frame-b')]);
  const models = ['model-a', 'model-b'].map((id) => readModel(byId(id), errorMaterial));
  stage.setModels(await Promise.all(models));
  connectControls(stage, errorMaterial, view);
  byId('view-status').textContent = '';
  byId('controls').disabled = false;
}

start().catch((error) => {
  console.error(error);
  byId('view-status').textContent = `No 3D view: ${error.message}`;
});
