// SPDX-License-Identifier: MIT
layout(location = 0) in vec4 positionAndOcclusion;
layout(location = 3) in uvec4 joints;
layout(location = 4) in vec4 weights;

out vec3 recordedPosition;

void main() {
    recordedPosition = transform(blendMotion(joints, weights), positionAndOcclusion.xyz);
}
