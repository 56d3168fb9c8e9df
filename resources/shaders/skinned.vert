// SPDX-License-Identifier: MIT
layout(location = 0) in vec4 positionAndOcclusion;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec3 templatePosition;
layout(location = 3) in uvec4 joints;
layout(location = 4) in vec4 weights;

#ifdef MARKS_SEGMENTS
// A bit for each segment.
uniform int selectedSegments;
uniform int solvedSegments;
uniform int assumedSegments;

// How much of the vertex belongs to selected, solved and assumed segments.
out vec3 shares;

vec3 sharesOf(uint joint, float weight) {
    int segment = kJointSegments[min(int(joint), kJointCount - 1)];
    return weight * vec3((ivec3(selectedSegments, solvedSegments, assumedSegments) >> segment) & 1);
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
    shares = sharesOf(joints.x, weights.x) + sharesOf(joints.y, weights.y) + sharesOf(joints.z, weights.z) +
             sharesOf(joints.w, weights.w);
#endif
    // Above the floor, for where it hides what is below and is not drawn after it.
    gl_ClipDistance[0] = worldPosition.z;
    gl_Position = viewProjection * vec4(worldPosition, 1.0);
}
