// SPDX-License-Identifier: MIT
// What all passes share in one picture; FrameBlock in passes/frame.h has the same layout (std140).
layout(std140) uniform Frame {
    mat4 viewProjection;
    mat4 lightViewProjection;
    mat4 inverseLightViewProjection;
    vec4 eye;              // w: 1 in perspective, 0 in an orthographic picture
    vec4 viewDirection;    // unit, away from the eye
    vec4 light;            // unit, towards the key light
    vec4 fill;             // unit, towards the fill light
    vec4 viewport;         // width, height, 1 / width, 1 / height in device pixels
    vec4 floorFade;        // centre x, y; radii where the fade begins and ends
    vec4 shadowRange;      // metres across the light's picture, metres deep, texel as share, 1 with shadows
    vec4 style;            // device pixels a logical pixel, floor drawn, origin drawn, opacity of the floor
    vec4 backgroundTop;
    vec4 backgroundBottom;
    vec4 floorColour;
    vec4 gridMajor;
    vec4 gridMinor;
    vec4 shadowColour;
    vec4 originColour;
    vec4 selectionColour;
    vec4 outlineColour;    // w: strength
};

vec3 towardsEye(vec3 world) {
    return mix(-viewDirection.xyz, normalize(eye.xyz - world), eye.w);
}

vec3 backgroundAt(vec2 pixel) {
    float height = pixel.y * viewport.w;
    return mix(backgroundBottom.rgb, backgroundTop.rgb, height * height * (3.0 - 2.0 * height));
}

// Half a step of noise at most: gradients of dark colours would show bands otherwise.
// Interleaved gradient noise after Jorge Jimenez, "Next Generation Post Processing in Call of Duty", 2014.
float dither(vec2 pixel) {
    return (fract(52.9829189 * fract(dot(pixel, vec2(0.06711056, 0.00583715)))) - 0.5) / 255.0;
}
