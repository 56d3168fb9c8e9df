// SPDX-License-Identifier: MIT
// With BARE_FLOOR its shadow is left to shaded_floor.frag.
in vec2 floorPosition;

uniform sampler2D floorShadow;

out vec4 fragment;

// How much of the pixel the nearest grid line covers, for lines `width` pixels wide every `spacing` metres. Lines that
// come closer than a few pixels fade out instead of making patterns.
float gridLines(vec2 at, vec2 pixelsPerMetre, float spacing, float width) {
    vec2 period = spacing * pixelsPerMetre;
    vec2 pixels = abs(fract(at * (1.0 / spacing) - 0.5) - 0.5) * period;
    vec2 covered = clamp(0.5 * width + 0.5 - pixels, 0.0, 1.0) * clamp((period - 4.0) * 0.1, 0.0, 1.0);
    return max(covered.x, covered.y);
}

// The triangle at the origin that points along x: 0.25 m long; distance inside in metres.
float originTriangle(vec2 at) {
    vec2 edge = vec2(0.4472, 0.8944);
    return min(at.x, dot(vec2(0.25 - at.x, -abs(at.y)), edge));
}

void main() {
    vec2 across = dFdx(floorPosition);
    vec2 down = dFdy(floorPosition);
    vec2 pixelsPerMetre = inversesqrt(max(across * across + down * down, vec2(1e-12)));
    float fade = floorStrength(floorPosition);

    float minor = gridLines(floorPosition, pixelsPerMetre, 0.25, style.x);
    float major = gridLines(floorPosition, pixelsPerMetre, 1.0, 1.25 * style.x);
    vec3 colour = floorColour.rgb;
    colour = mix(colour, gridMinor.rgb, 0.75 * minor);
    colour = mix(colour, gridMajor.rgb, 0.9 * major);
    float sharpness = min(pixelsPerMetre.x, pixelsPerMetre.y);
    float triangle = clamp(originTriangle(floorPosition) * sharpness + 0.5, 0.0, 1.0) * style.z;
    colour = mix(colour, originColour.rgb, triangle);

#ifndef BARE_FLOOR
    vec4 inLight = lightViewProjection * vec4(floorPosition, 0.0, 1.0);
    vec2 hidden = texture(floorShadow, 0.5 * inLight.xy + 0.5).rg * shadowRange.w;
    colour = mix(colour, shadowColour.rgb * (0.55 + 0.45 * colour / max(floorColour.rgb, vec3(0.01))),
                 shadowDarkness(hidden));
#endif

    // The fade is into the background that belongs there, so that nothing has to be blended. From below the floor
    // must not hide the characters.
    colour = mix(backgroundAt(gl_FragCoord.xy), colour, fade);
    fragment = vec4(colour + dither(gl_FragCoord.xy), style.w);
}
