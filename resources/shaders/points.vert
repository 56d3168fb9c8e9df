// SPDX-License-Identifier: MIT
layout(location = 0) in vec4 positionAndDiameter;
layout(location = 1) in vec4 pointColour;
layout(location = 2) in float behind;

uniform float isBehind;

flat out vec2 centre;
flat out vec4 paint;
flat out float radius;

void main() {
    vec4 clip = viewProjection * vec4(positionAndDiameter.xyz, 1.0);
    radius = 0.5 * positionAndDiameter.w * style.x;
    paint = vec4(pointColour.rgb, pointColour.a * mix(1.0, behind, isBehind));
    centre = (0.5 * clip.xy / clip.w + 0.5) * viewport.xy;
    vec2 corner = centre + (2.0 * vec2(gl_VertexID & 1, gl_VertexID >> 1) - 1.0) * (radius + 1.5 * style.x + 1.0);
    gl_Position = clip.w < 0.01 || paint.a <= 0.0
                      ? vec4(2.0, 2.0, 2.0, 1.0)
                      : vec4((2.0 * corner * viewport.zw - 1.0) * clip.w, clip.z, clip.w);
}
