// SPDX-License-Identifier: MIT
out vec2 floorPosition;

void main() {
    vec2 corner = 2.0 * vec2(gl_VertexID & 1, gl_VertexID >> 1) - 1.0;
    floorPosition = floorFade.xy + corner * floorFade.w;
    gl_Position = viewProjection * vec4(floorPosition, 0.0, 1.0);
}
