// Reads a model of the page: its surface with materials, its error surface, and its edges.
import { Group, Mesh, MeshBasicMaterial } from 'three';
import { MeshoptDecoder } from 'three/addons/libs/meshopt_decoder.module.js';
import { GLTFLoader } from 'three/addons/loaders/GLTFLoader.js';

const wires = new MeshBasicMaterial({ wireframe: true, color: 0x10131a, transparent: true, opacity: 0.4 });

function bytesOf(element) {
  const text = atob(element.textContent.trim());
  element.remove(); // frees the memory of the text
  return Uint8Array.from(text, (character) => character.charCodeAt(0)).buffer;
}

// Moves faces slightly away from the camera, so that they do not hide their edges (z-fighting).
function pushBack(material) {
  Object.assign(material, { polygonOffset: true, polygonOffsetFactor: 1, polygonOffsetUnits: 1 });
}

/// Parses the GLB file of a model, which has two meshes: `look`, the model itself, and `error`, whose texture
/// coordinate u is the root of the distance to the other model, as a share of the largest. \return the three objects that can be shown
export async function readModel(element, errorMaterial) {
  const { scene } = await new GLTFLoader().setMeshoptDecoder(MeshoptDecoder).parseAsync(bytesOf(element), '');
  const look = scene.getObjectByName('look'), error = scene.getObjectByName('error'), edges = new Group();
  scene.updateMatrixWorld();
  look.traverse((object) => {
    if (!object.isMesh) return;
    pushBack(object.material);
    const wire = new Mesh(object.geometry, wires);
    wire.applyMatrix4(object.matrixWorld);
    edges.add(wire);
  });
  pushBack(errorMaterial);
  error.traverse((object) => {
    if (object.isMesh) object.material = errorMaterial;
  });
  return { look, error, edges };
}
