// SPDX-License-Identifier: MIT
// One triangle over the rectangle `region` (x, y, width, height in device coordinates), at the far plane.
uniform vec4 region;

void main() {
    vec2 corner = vec2(gl_VertexID & 1, gl_VertexID >> 1);
    gl_Position = vec4(region.xy + corner * region.zw, 1.0, 1.0);
}
