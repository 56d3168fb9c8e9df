// SPDX-License-Identifier: MIT
layout(location = 0) in vec4 positionAndOcclusion;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec3 templatePosition;
layout(location = 3) in uvec4 joints;
layout(location = 4) in vec4 weights;
#ifdef OWN_CHARACTER
layout(location = 6) in vec2 texturePlaceAt;

out vec2 texturePlace;
#endif

#ifdef MARKS_SEGMENTS
// Those of the joints.
layout(location = 5) in uvec4 segments;

// A bit for each segment.
uniform int selectedSegments;
uniform int solvedSegments;
uniform int assumedSegments;

// How much of the vertex belongs to selected, solved and assumed segments.
out vec3 shares;

vec3 sharesOf(uint segment, float weight) {
    return weight * vec3((ivec3(selectedSegments, solvedSegments, assumedSegments) >> int(segment)) & 1);
}

#endif

out vec3 worldPosition;
out vec3 worldNormal;
out vec3 suitPosition;
out float occlusion;

void main() {
    Motion motion = blendMotion(joints, weights);
    worldPosition = transform(motion, positionAndOcclusion.xyz);
    worldNormal = rotate(motion, normal);
    suitPosition = templatePosition;
    occlusion = positionAndOcclusion.w;
#ifdef MARKS_SEGMENTS
    shares = sharesOf(segments.x, weights.x) + sharesOf(segments.y, weights.y) + sharesOf(segments.z, weights.z) +
             sharesOf(segments.w, weights.w);
#endif
#ifdef OWN_CHARACTER
    texturePlace = texturePlaceAt;
#endif
    // Above the floor, for where it hides what is below and is not drawn after it.
    gl_ClipDistance[0] = worldPosition.z;
    gl_Position = viewProjection * vec4(worldPosition, 1.0);
}
