// SPDX-License-Identifier: MIT
layout(location = 0) in vec4 positionAndOcclusion;
layout(location = 1) in vec3 normal;
layout(location = 2) in uvec4 joints;
layout(location = 3) in vec4 weights;
#ifdef OWN_CHARACTER
layout(location = 4) in vec2 texturePlaceAt;

out vec2 texturePlace;
#endif

#ifdef MARKS_SEGMENTS
// How much of the vertex belongs to selected, solved and assumed segments.
out vec3 shares;

#endif

layout(location = 6) in vec4 colourAndDim;
layout(location = 7) in vec2 opacityAndHatched;

flat out vec3 colour;
flat out float dim;
flat out float opacity;
flat out float hatched;

// The mesh's cube: its lowest corner and its side. The suit is painted on the body as it was modelled.
uniform vec4 cube;

out vec3 worldPosition;
out vec3 worldNormal;
out vec3 suitPosition;
out float occlusion;

void main() {
    colour = colourAndDim.rgb;
    dim = colourAndDim.a;
    opacity = opacityAndHatched.x;
    hatched = opacityAndHatched.y;
    Motion motion = blendMotion(joints, weights);
    Body body = fitted(positionAndOcclusion.xyz, joints, weights);
    worldPosition = transform(motion, body.position);
    worldNormal = rotate(motion, normalize(normal / body.scale));
    suitPosition = cube.xyz + cube.w * positionAndOcclusion.xyz;
    occlusion = positionAndOcclusion.w;
#ifdef MARKS_SEGMENTS
    shares = vec3(shareOf(character.y, joints, weights), shareOf(character.z, joints, weights),
                  shareOf(character.w, joints, weights));
#endif
#ifdef OWN_CHARACTER
    texturePlace = texturePlaceAt;
#endif
    // Above the floor, for where it hides what is below and is not drawn after it.
    gl_ClipDistance[0] = worldPosition.z;
    gl_Position = viewProjection * vec4(worldPosition, 1.0);
}
