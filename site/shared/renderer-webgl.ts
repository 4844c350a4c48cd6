// All boxes in one instanced draw call, straight from their Float32Array. The fragment shader computes how much of
// each pixel a box covers, so boxes of a pixel or less glide instead of flickering, and draws an outline inside the
// boxes that are large enough to show one.
import { density } from './density.ts';
import { cellSlot, slotCount } from './groups.ts';
import * as look from './look.ts';
import type { BoxRenderer } from './renderer.ts';

/** A number as GLSL takes it. */
const float = (value: number) => value.toFixed(2);
const [outlineFrom, lightFrom] = [float(look.outlineFrom), float(look.lightFrom)];

const vertexSource = `#version 300 es
layout(location = 0) in vec4 box;
layout(location = 1) in uint slot;
uniform vec4 palette[${slotCount}];
uniform vec2 centre, size;
uniform float scale;
flat out vec4 edges;
flat out vec4 colour;
flat out float light;
out vec2 pixel;
void main() {
  vec4 placed = clamp((box - centre.xyxy) * scale + size.xyxy * 0.5, vec4(${float(-look.overhang)}), size.xyxy + ${float(look.overhang)});
  vec2 middle = (placed.xy + placed.zw) * 0.5;
  vec2 reach = max((placed.zw - placed.xy) * 0.5, 0.5);
  edges = vec4(middle - reach, middle + reach);
  colour = palette[slot];
  light = slot == ${cellSlot}u ? 0.0 : ${float(look.light)};
  vec2 corner = vec2(gl_VertexID & 1, gl_VertexID >> 1) * 2.0 - 1.0;
  pixel = middle + corner * (reach + 0.5);
  gl_Position = vec4(pixel / size * 2.0 - 1.0, 0.0, 1.0);
}`;

const fragmentSource = `#version 300 es
precision highp float;
uniform float density;
flat in vec4 edges;
flat in vec4 colour;
flat in float light;
in vec2 pixel;
out vec4 result;
void main() {
  vec2 covered = clamp(min(edges.zw, pixel + 0.5) - max(edges.xy, pixel - 0.5), 0.0, 1.0);
  vec2 inside = min(pixel - edges.xy, edges.zw - pixel);
  vec2 extent = edges.zw - edges.xy;
  float fill = mix(${float(look.solid)}, light, smoothstep(${outlineFrom}, ${lightFrom}, min(extent.x, extent.y) / density));
  float outline = clamp(${float(look.outlineWidth)} * density + 0.5 - min(inside.x, inside.y), 0.0, 1.0);
  float alpha = colour.a * covered.x * covered.y * mix(fill, 1.0, outline);
  result = vec4(colour.rgb * alpha, alpha);
}`;

interface Program {
  boxes: WebGLBuffer;
  slots: WebGLBuffer;
  uniform: (name: string) => WebGLUniformLocation | null;
}

function build(gl: WebGL2RenderingContext): Program {
  const program = gl.createProgram();
  for (const [type, source] of [
    [gl.VERTEX_SHADER, vertexSource],
    [gl.FRAGMENT_SHADER, fragmentSource],
  ] as const) {
    const shader = gl.createShader(type)!;
    gl.shaderSource(shader, source);
    gl.compileShader(shader);
    gl.attachShader(program, shader);
  }
  gl.linkProgram(program);
  if (!gl.getProgramParameter(program, gl.LINK_STATUS) && !gl.isContextLost()) {
    const logs = gl.getAttachedShaders(program)!.map((shader) => gl.getShaderInfoLog(shader));
    throw new Error(`the box shaders do not compile: ${[gl.getProgramInfoLog(program), ...logs].join('\n')}`);
  }
  gl.useProgram(program);

  const boxes = gl.createBuffer();
  gl.bindBuffer(gl.ARRAY_BUFFER, boxes);
  gl.enableVertexAttribArray(0);
  gl.vertexAttribPointer(0, 4, gl.FLOAT, false, 0, 0);
  gl.vertexAttribDivisor(0, 1);
  const slots = gl.createBuffer();
  gl.bindBuffer(gl.ARRAY_BUFFER, slots);
  gl.enableVertexAttribArray(1);
  gl.vertexAttribIPointer(1, 1, gl.UNSIGNED_BYTE, 0, 0);
  gl.vertexAttribDivisor(1, 1);

  gl.enable(gl.BLEND);
  gl.blendFunc(gl.ONE, gl.ONE_MINUS_SRC_ALPHA);
  const places = new Map<string, WebGLUniformLocation | null>();
  for (const name of ['palette', 'centre', 'size', 'scale', 'density']) {
    places.set(name, gl.getUniformLocation(program, name));
  }
  return { boxes, slots, uniform: (name) => places.get(name) ?? null };
}

/** A WebGL renderer with one of these names runs on the CPU, far slower than the 2D canvas. */
const software = /swiftshader|llvmpipe|softpipe|software|basic render/i;

/** Whether WebGL2 runs on a GPU. Tested on a canvas of its own, since a canvas is bound to its first context. */
export function hasFastWebgl(): boolean {
  const gl = document.createElement('canvas').getContext('webgl2', { failIfMajorPerformanceCaveat: true });
  if (!gl) return false;
  const names = gl.getExtension('WEBGL_debug_renderer_info');
  const name = String(gl.getParameter(names ? names.UNMASKED_RENDERER_WEBGL : gl.RENDERER));
  gl.getExtension('WEBGL_lose_context')?.loseContext();
  return !software.test(name);
}

/** undefined if there is no WebGL2. */
export function createWebglRenderer(canvas: HTMLCanvasElement, redraw: () => void): BoxRenderer | undefined {
  const gl = canvas.getContext('webgl2', { alpha: false, antialias: false, depth: false });
  if (!gl) return undefined;
  let program = build(gl);
  let palette: Float32Array | undefined;
  let background: readonly [number, number, number] = [0, 0, 0];

  const usePalette = () => {
    if (palette) gl.uniform4fv(program.uniform('palette'), palette);
    gl.clearColor(...background, 1);
  };
  canvas.addEventListener('webglcontextlost', (event) => event.preventDefault());
  canvas.addEventListener('webglcontextrestored', () => {
    program = build(gl);
    usePalette();
    redraw();
  });

  return {
    kind: 'webgl2',
    setPalette(next) {
      palette = next.slots;
      background = next.background;
      usePalette();
    },
    draw(boxes, slots, count, camera) {
      gl.viewport(0, 0, camera.width, camera.height);
      gl.clear(gl.COLOR_BUFFER_BIT);
      gl.uniform2f(program.uniform('centre'), camera.x, camera.y);
      gl.uniform2f(program.uniform('size'), camera.width, camera.height);
      gl.uniform1f(program.uniform('scale'), camera.scale);
      gl.uniform1f(program.uniform('density'), density());
      gl.bindBuffer(gl.ARRAY_BUFFER, program.boxes);
      gl.bufferData(gl.ARRAY_BUFFER, boxes, gl.STREAM_DRAW, 0, count * 4);
      gl.bindBuffer(gl.ARRAY_BUFFER, program.slots);
      gl.bufferData(gl.ARRAY_BUFFER, slots, gl.STREAM_DRAW, 0, count);
      gl.drawArraysInstanced(gl.TRIANGLE_STRIP, 0, 4, count);
    },
  };
}
