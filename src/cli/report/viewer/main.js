// The 3D view of a page of `faqem report`: both models with a shared camera. The page contains the models as
// base64 GLB and the scale of the heat map in #view-data. The rest of the page works without this script.
import { makeErrorMaterial } from './error_material.js';
import { readModel } from './model.js';
import { makeStage } from './stage.js';

const byId = (id) => document.getElementById(id);

function connectControls(stage, errorMaterial, view) {
  const wireframe = byId('wireframe'), error = byId('error'), limit = byId('limit');
  const show = () => stage.show({ wireframe: wireframe.checked, error: error.checked });
  const colour = () => {
    // The slider is quadratic, because most distances are much smaller than the maximum.
    const value = view.max_distance * limit.value ** 2;
    errorMaterial.uniforms.limit.value = limit.value ** 2;
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
  byId('scale').hidden = !error.checked; // browsers may restore the check boxes on reload
  colour();
  show();
}

async function start() {
  const view = JSON.parse(byId('view-data').textContent);
  const errorMaterial = makeErrorMaterial(view.ramp);
  const stage = makeStage(byId('canvas'), [byId('frame-a'), byId('frame-b')], view.up);
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
