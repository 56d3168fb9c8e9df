// SPDX-License-Identifier: MIT
// Smooths edges along their direction, after Timothy Lottes, "FXAA" (NVIDIA, 2009), the variant with few samples.
uniform sampler2D picture;

out vec4 fragment;

float brightness(vec3 colour) {
    return dot(colour, vec3(0.30, 0.59, 0.11));
}

vec3 at(vec2 pixel) {
    return texture(picture, pixel * viewport.zw).rgb;
}

void main() {
    vec2 centre = gl_FragCoord.xy;
    vec3 here = at(centre);
    float downLeft = brightness(at(centre + vec2(-1.0, -1.0)));
    float downRight = brightness(at(centre + vec2(1.0, -1.0)));
    float upLeft = brightness(at(centre + vec2(-1.0, 1.0)));
    float upRight = brightness(at(centre + vec2(1.0, 1.0)));
    float middle = brightness(here);
    float lowest = min(middle, min(min(downLeft, downRight), min(upLeft, upRight)));
    float highest = max(middle, max(max(downLeft, downRight), max(upLeft, upRight)));

    vec2 along = vec2(upLeft + upRight - downLeft - downRight, downLeft + upLeft - downRight - upRight);
    float reduce = max(0.03125 * (downLeft + downRight + upLeft + upRight), 1.0 / 128.0);
    along = clamp(along / (min(abs(along.x), abs(along.y)) + reduce), -8.0, 8.0);

    vec3 narrow = 0.5 * (at(centre - along / 6.0) + at(centre + along / 6.0));
    vec3 wide = 0.5 * narrow + 0.25 * (at(centre - 0.5 * along) + at(centre + 0.5 * along));
    float wideBrightness = brightness(wide);
    vec3 smoothed = wideBrightness < lowest || wideBrightness > highest ? narrow : wide;
    fragment = vec4(highest - lowest < max(0.04, 0.10 * highest) ? here : smoothed, 1.0);
}
