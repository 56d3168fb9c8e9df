// SPDX-License-Identifier: MIT
// Puts the shadow on a floor that is drawn already: what floor.frag makes of a colour is `keep` times it and `add`.
in vec2 floorPosition;

uniform sampler2D floorShadow;

layout(location = 0, index = 0) out vec4 add;
layout(location = 0, index = 1) out vec4 keep;

void main() {
    vec4 inLight = lightViewProjection * vec4(floorPosition, 0.0, 1.0);
    vec2 hidden = texture(floorShadow, 0.5 * inLight.xy + 0.5).rg * shadowRange.w;
    float dark = shadowDarkness(hidden);
    float fade = floorStrength(floorPosition);
    vec3 kept = 1.0 - dark + dark * 0.45 * shadowColour.rgb / max(floorColour.rgb, vec3(0.01));
    vec3 behind = backgroundAt(gl_FragCoord.xy) * (1.0 - fade);
    add = vec4(behind * (1.0 - kept) + fade * dark * 0.55 * shadowColour.rgb, 1.0);
    keep = vec4(kept, 1.0);
}
