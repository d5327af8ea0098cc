// Material that colours faces by distance, with slight shading by the face normal to make the shape visible.
import { DataTexture, DoubleSide, LinearFilter, ShaderMaterial } from 'three';

const vertexShader = `
  varying float error;
  varying vec3 viewPosition;
  void main() {
    vec4 seen = modelViewMatrix * vec4(position, 1.0);
    error = uv.x;
    viewPosition = seen.xyz;
    gl_Position = projectionMatrix * seen;
  }`;

const fragmentShader = `
  uniform sampler2D ramp;
  uniform float stops, limit;
  varying float error;
  varying vec3 viewPosition;
  void main() {
    float share = limit > 0.0 ? clamp(error * error / limit, 0.0, 1.0) : 0.0;
    vec3 colour = texture2D(ramp, vec2((share * (stops - 1.0) + 0.5) / stops, 0.5)).rgb;
    vec3 normal = normalize(cross(dFdx(viewPosition), dFdy(viewPosition)));
    gl_FragColor = vec4(colour * (0.65 + 0.35 * abs(normal.z)), 1.0);
  }`;

/// Creates the material. \param ramp  sRGB colours, 0 to 255, from zero distance to the end of the colour
/// scale
export function makeErrorMaterial(ramp) {
  const texture = new DataTexture(Uint8Array.from(ramp.flatMap((colour) => [...colour, 255])), ramp.length, 1);
  texture.minFilter = texture.magFilter = LinearFilter;
  texture.needsUpdate = true;
  return new ShaderMaterial({
    uniforms: { ramp: { value: texture }, stops: { value: ramp.length }, limit: { value: 1 } },
    vertexShader,
    fragmentShader,
    side: DoubleSide,
  });
}
