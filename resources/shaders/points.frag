// SPDX-License-Identifier: MIT
flat in vec2 centre;
flat in vec4 paint;
flat in float radius;

out vec4 fragment;

void main() {
    vec2 offset = gl_FragCoord.xy - centre;
    float away = length(offset);
    float core = clamp(radius - away + 0.5, 0.0, 1.0);
    float outline = clamp(radius + style.x - away + 0.5, 0.0, 1.0) * outlineColour.a;
    float cover = max(core, outline);
    // A little light from above makes it a ball.
    vec3 ball = paint.rgb * (0.88 + 0.22 * clamp(offset.y / max(radius, 1.0), -1.0, 1.0));
    fragment = vec4(mix(outlineColour.rgb, ball, core / max(cover, 1e-4)), cover * paint.a);
}
