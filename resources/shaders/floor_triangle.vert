// SPDX-License-Identifier: MIT
// The triangle at the origin that points along x: 0.25 m long.
out vec4 paint;

void main() {
    vec2 at = gl_VertexID == 0 ? vec2(0.25, 0.0) : vec2(0.0, 0.125 * (gl_VertexID == 1 ? 1.0 : -1.0));
    paint = vec4(originColour.rgb, floorStrength(at));
    gl_Position = viewProjection * vec4(at, 0.0, 1.0);
}
