// SPDX-License-Identifier: MIT
in vec3 worldPosition;
in vec3 worldNormal;
in vec3 suitPosition;
in vec2 occlusionAndSelection;

uniform sampler2DShadow shadowMap;
uniform vec3 colour;
uniform float hasSuit;
uniform float dim;
uniform float opacity;
uniform float hatched;

out vec4 fragment;

// 1 in the light. Six bilinear comparisons about the point soften the edge by five texels. Where the light only grazes
// the surface, a texel of its picture covers much of it: there the point is looked up farther outside.
float lit(vec3 position, vec3 normal, float facing) {
    float outside = 0.012 + 0.022 * (1.0 - max(facing, 0.0));
    vec4 inLight = lightViewProjection * vec4(position + outside * normal, 1.0);
    vec3 at = 0.5 * inLight.xyz + 0.5;
    at.z -= 0.004 / shadowRange.y;
    float texel = shadowRange.z;
    float sum = texture(shadowMap, at + vec3(-0.7, -1.7, 0.0) * texel) +
                texture(shadowMap, at + vec3(1.3, -0.9, 0.0) * texel) +
                texture(shadowMap, at + vec3(-1.8, 0.2, 0.0) * texel) +
                texture(shadowMap, at + vec3(0.2, 0.2, 0.0) * texel) +
                texture(shadowMap, at + vec3(1.7, 1.0, 0.0) * texel) +
                texture(shadowMap, at + vec3(-0.5, 1.7, 0.0) * texel);
    return mix(1.0, sum / 6.0, shadowRange.w);
}

vec3 shade(Paint paint, vec3 normal, vec3 view, float occlusion) {
    float facing = dot(normal, light.xyz);
    float visible = lit(worldPosition, normal, facing);
    float hemisphere = 0.5 * normal.z + 0.5;
    float key = max(facing, 0.0) * visible;
    float fillLight = max(dot(normal, fill.xyz), 0.0);
    vec3 ambient = mix(vec3(0.23, 0.23, 0.24), vec3(0.50, 0.51, 0.53), hemisphere);
    vec3 result = paint.colour * (occlusion * (ambient + 0.09 * fillLight) + vec3(0.71, 0.70, 0.68) * key);

    vec3 middle = normalize(light.xyz + view);
    float shine = max(dot(normal, middle), 0.0);
    float shine2 = shine * shine;
    float shine4 = shine2 * shine2;
    float shine8 = shine4 * shine4;
    float sharp = shine8 * shine8 * shine8 * shine8 * shine8;
    float grazing = 1.0 - max(dot(normal, view), 0.0);
    float rim = grazing * grazing * grazing;
    result += paint.gloss * visible * step(0.0, facing) * (0.13 * sharp + 0.045 * shine8);
    result += 0.11 * rim * occlusion * (0.35 + 0.65 * hemisphere);
    // Lifts the middle as a power of 1 / 1.15 does, at a third of its cost.
    result = clamp(result, 0.0, 1.0);
    return result * (1.22 - 0.22 * result);
}

void main() {
    vec3 normal = normalize(worldNormal);
    vec3 view = towardsEye(worldPosition);
    float metresPerPixel = length(fwidth(suitPosition)) * 0.7;
    Paint paint = Paint(colour * 0.86 + 0.10, 1.0);
    if (hasSuit > 0.5) {
        paint = paintSuit(suitPosition, colour, metresPerPixel);
    }
    float selection = occlusionAndSelection.y;
    float selected = smoothstep(0.42, 0.58, selection);
    vec3 pale = 0.5 * selectionColour.rgb + 0.5;
    paint.colour = mix(paint.colour, pale, 0.55 * selected);
    // The baked occlusion is of skin that touches: as it is, creases and fingers would turn black.
    vec3 result = shade(paint, normal, view, 0.35 + 0.65 * occlusionAndSelection.x);
    // Blue grows towards the sides, and a line runs where the segment ends: both show on a suit of any colour.
    float side = 1.0 - max(dot(normal, view), 0.0);
    result = mix(result, selectionColour.rgb, selected * (0.25 + 0.55 * side));
    float border = abs(selection - 0.5) / max(fwidth(selection), 1e-4);
    result = mix(result, pale, step(0.02, selection) * (1.0 - smoothstep(0.6 * style.x, 1.6 * style.x, border)));

    vec3 background = backgroundAt(gl_FragCoord.xy);
    float grey = dot(result, vec3(0.30, 0.59, 0.11));
    result = mix(result, mix(vec3(grey), background, 0.35), dim);
    float stripe = abs(fract((gl_FragCoord.x + gl_FragCoord.y) / (11.0 * style.x)) - 0.5) * 11.0 * style.x;
    float gap = smoothstep(2.6 * style.x - 0.7, 2.6 * style.x + 0.7, stripe);
    result = mix(result, background, 0.72 * hatched * gap);
    fragment = vec4(result + dither(gl_FragCoord.xy), opacity);
}
