// SPDX-License-Identifier: MIT
layout(location = 0) in vec4 positionAndOcclusion;
layout(location = 2) in uvec4 joints;
layout(location = 3) in vec4 weights;

out vec3 recordedPosition;

void main() {
    recordedPosition = transform(blendMotion(joints, weights), fitted(positionAndOcclusion.xyz, joints, weights).position);
}
