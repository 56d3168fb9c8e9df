// SPDX-License-Identifier: MIT
// A line as a rectangle on the screen, with room for its round ends, its outline and a soft edge.
layout(location = 0) in vec4 fromAndWidth;
layout(location = 1) in vec4 toAndBehind;
layout(location = 2) in vec4 lineColour;

uniform float isBehind;

flat out vec4 ends;      // device pixels
flat out vec4 paint;
flat out float radius;   // device pixels

const float kNear = 0.01;

void main() {
    vec4 from = viewProjection * vec4(fromAndWidth.xyz, 1.0);
    vec4 to = viewProjection * vec4(toAndBehind.xyz, 1.0);
    // What is behind the eye would come out mirrored.
    if (from.w < kNear) {
        from = mix(from, to, clamp((kNear - from.w) / (to.w - from.w), 0.0, 1.0));
    }
    if (to.w < kNear) {
        to = mix(to, from, clamp((kNear - to.w) / (from.w - to.w), 0.0, 1.0));
    }
    vec2 a = (0.5 * from.xy / from.w + 0.5) * viewport.xy;
    vec2 b = (0.5 * to.xy / to.w + 0.5) * viewport.xy;
    ends = vec4(a, b);
    radius = 0.5 * fromAndWidth.w * style.x;
    paint = vec4(lineColour.rgb, lineColour.a * mix(1.0, toAndBehind.w, isBehind));

    float reach = radius + 1.5 * style.x + 1.0;
    vec2 direction = b - a;
    float span = length(direction);
    direction = span > 1e-3 ? direction / span : vec2(1.0, 0.0);
    vec2 across = vec2(-direction.y, direction.x);
    bool isEnd = (gl_VertexID & 1) != 0;
    vec2 corner = (isEnd ? b + reach * direction : a - reach * direction) +
                  across * reach * ((gl_VertexID & 2) != 0 ? 1.0 : -1.0);
    vec4 base = isEnd ? to : from;
    bool isHidden = from.w < 0.5 * kNear || to.w < 0.5 * kNear || paint.a <= 0.0;
    gl_Position = isHidden ? vec4(2.0, 2.0, 2.0, 1.0)
                           : vec4((2.0 * corner * viewport.zw - 1.0) * base.w, base.z, base.w);
}
