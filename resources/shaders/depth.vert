// SPDX-License-Identifier: MIT
layout(location = 0) in vec4 positionAndOcclusion;
layout(location = 3) in uvec4 joints;
layout(location = 4) in vec4 weights;

void main() {
    Motion motion = blendMotion(joints, weights);
    gl_Position = lightViewProjection * vec4(transform(motion, positionAndOcclusion.xyz), 1.0);
}
