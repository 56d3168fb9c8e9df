// SPDX-License-Identifier: MIT
#include "render/gl/handle.h"

#include <epoxy/gl.h>

namespace posewire::render::gl {

void deleteBuffer(unsigned name) {
    glDeleteBuffers(1, &name);
}

void deleteVertexArray(unsigned name) {
    glDeleteVertexArrays(1, &name);
}

void deleteShader(unsigned name) {
    glDeleteShader(name);
}

void deleteProgram(unsigned name) {
    glDeleteProgram(name);
}

void deleteTexture(unsigned name) {
    glDeleteTextures(1, &name);
}

void deleteFramebuffer(unsigned name) {
    glDeleteFramebuffers(1, &name);
}

void deleteRenderbuffer(unsigned name) {
    glDeleteRenderbuffers(1, &name);
}

void deleteSampler(unsigned name) {
    glDeleteSamplers(1, &name);
}

} // namespace posewire::render::gl
