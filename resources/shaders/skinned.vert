// SPDX-License-Identifier: MIT
layout(location = 0) in vec4 positionAndOcclusion;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec3 templatePosition;
layout(location = 3) in uvec4 joints;
layout(location = 4) in vec4 weights;

uniform int selectedSegment;

out vec3 worldPosition;
out vec3 worldNormal;
out vec3 suitPosition;
out vec2 occlusionAndSelection;

// The segment that each twist joint (23 and up) belongs to.
const int kTwistSegments[6] = int[6](8, 12, 9, 13, 15, 19);

float share(uint joint, float weight) {
    int segment = joint < 23u ? int(joint) : kTwistSegments[min(int(joint) - 23, 5)];
    return segment == selectedSegment ? weight : 0.0;
}

void main() {
    Motion motion = blendMotion(joints, weights);
    worldPosition = transform(motion, positionAndOcclusion.xyz);
    worldNormal = rotate(motion, normal);
    suitPosition = templatePosition;
    float selection = 0.0;
    if (selectedSegment >= 0) {
        selection = share(joints.x, weights.x) + share(joints.y, weights.y) + share(joints.z, weights.z) +
                    share(joints.w, weights.w);
    }
    occlusionAndSelection = vec2(positionAndOcclusion.w, selection);
    gl_Position = viewProjection * vec4(worldPosition, 1.0);
}
