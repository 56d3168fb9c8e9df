// SPDX-License-Identifier: MIT
// The part of the floor whose shadow lies in a rectangle of the light's picture.
layout(location = 0) in vec4 rectangle; // x, y, width, height in device coordinates of the light

out vec2 floorPosition;

void main() {
    vec2 device = rectangle.xy + vec2(gl_VertexID & 1, gl_VertexID >> 1) * rectangle.zw;
    vec3 near = (inverseLightViewProjection * vec4(device, -1.0, 1.0)).xyz;
    vec3 far = (inverseLightViewProjection * vec4(device, 1.0, 1.0)).xyz;
    floorPosition = mix(near, far, near.z / (near.z - far.z)).xy;
    gl_Position = viewProjection * vec4(floorPosition, 0.0, 1.0);
}
