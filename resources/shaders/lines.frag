// SPDX-License-Identifier: MIT
flat in vec4 ends;
flat in vec4 paint;
flat in float radius;

out vec4 fragment;

void main() {
    vec2 line = ends.zw - ends.xy;
    vec2 offset = gl_FragCoord.xy - ends.xy;
    float along = clamp(dot(offset, line) / max(dot(line, line), 1e-6), 0.0, 1.0);
    float away = length(offset - along * line);
    float core = clamp(radius - away + 0.5, 0.0, 1.0);
    float outline = clamp(radius + style.x - away + 0.5, 0.0, 1.0) * outlineColour.a;
    float cover = max(core, outline);
    fragment = vec4(mix(outlineColour.rgb, paint.rgb, core / max(cover, 1e-4)), cover * paint.a);
}
