// SPDX-License-Identifier: MIT
#include "render/offscreen.h"

#include <array>
#include <cstdio>
#include <string_view>
#include <utility>

#include <epoxy/egl.h>

namespace posewire::render {
namespace {

std::string eglFailure(std::string_view step) {
    std::array<char, 16> code{};
    std::snprintf(code.data(), code.size(), "0x%04x", static_cast<unsigned>(eglGetError()));
    return std::string(step) + " failed (EGL error " + code.data() + ")";
}

EGLDisplay surfacelessDisplay() {
    if (!epoxy_has_egl_extension(EGL_NO_DISPLAY, "EGL_MESA_platform_surfaceless")) {
        return EGL_NO_DISPLAY;
    }
    return eglGetPlatformDisplayEXT(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr);
}

EGLDisplay deviceDisplay() {
    if (!epoxy_has_egl_extension(EGL_NO_DISPLAY, "EGL_EXT_platform_device") ||
        !epoxy_has_egl_extension(EGL_NO_DISPLAY, "EGL_EXT_device_enumeration")) {
        return EGL_NO_DISPLAY;
    }
    EGLDeviceEXT device = nullptr;
    EGLint count = 0;
    if (eglQueryDevicesEXT(1, &device, &count) == EGL_FALSE || count < 1) {
        return EGL_NO_DISPLAY;
    }
    return eglGetPlatformDisplayEXT(EGL_PLATFORM_DEVICE_EXT, device, nullptr);
}

struct Made {
    EGLDisplay display = EGL_NO_DISPLAY;
    EGLContext context = EGL_NO_CONTEXT;
};

tl::expected<Made, std::string> makeContext(EGLDisplay display, std::string_view platform) {
    const std::string where = "EGL on the " + std::string(platform) + " platform: ";
    if (display == EGL_NO_DISPLAY) {
        return tl::unexpected(where + "not offered");
    }
    if (eglInitialize(display, nullptr, nullptr) == EGL_FALSE) {
        return tl::unexpected(where + eglFailure("eglInitialize"));
    }
    if (eglBindAPI(EGL_OPENGL_API) == EGL_FALSE) {
        return tl::unexpected(where + eglFailure("eglBindAPI"));
    }
    constexpr std::array<EGLint, 7> kAttributes{EGL_CONTEXT_MAJOR_VERSION,
                                                3,
                                                EGL_CONTEXT_MINOR_VERSION,
                                                3,
                                                EGL_CONTEXT_OPENGL_PROFILE_MASK,
                                                EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                                                EGL_NONE};
    const EGLContext context =
        eglCreateContext(display, EGL_NO_CONFIG_KHR, EGL_NO_CONTEXT, kAttributes.data());
    if (context == EGL_NO_CONTEXT) {
        return tl::unexpected(where + eglFailure("eglCreateContext"));
    }
    if (eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, context) == EGL_FALSE) {
        std::string error = where + eglFailure("eglMakeCurrent");
        eglDestroyContext(display, context);
        return tl::unexpected(std::move(error));
    }
    return Made{display, context};
}

} // namespace

/// The display is the process's own and stays initialised: terminating it would end other contexts too.
struct OffscreenContext::Impl {
    EGLDisplay display = EGL_NO_DISPLAY;
    EGLContext context = EGL_NO_CONTEXT;

    Impl(EGLDisplay ownDisplay, EGLContext ownContext) : display(ownDisplay), context(ownContext) {}
    Impl(const Impl&) = delete;
    Impl& operator=(const Impl&) = delete;
    ~Impl() {
        release();
        eglDestroyContext(display, context);
    }

    void release() {
        eglBindAPI(EGL_OPENGL_API);
        if (eglGetCurrentContext() == context) {
            eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
        }
    }
};

OffscreenContext::OffscreenContext(std::unique_ptr<Impl> impl) : m_impl(std::move(impl)) {}
OffscreenContext::OffscreenContext(OffscreenContext&&) noexcept = default;
OffscreenContext& OffscreenContext::operator=(OffscreenContext&&) noexcept = default;
OffscreenContext::~OffscreenContext() = default;

tl::expected<OffscreenContext, std::string> OffscreenContext::create() {
    if (!epoxy_has_egl()) {
        return tl::unexpected(std::string("libEGL is not installed: no OpenGL without a window"));
    }
    tl::expected<Made, std::string> made = makeContext(surfacelessDisplay(), "surfaceless");
    if (!made) {
        std::string error = std::move(made.error());
        made = makeContext(deviceDisplay(), "device");
        if (!made) {
            return tl::unexpected(error + "; " + made.error());
        }
    }
    return OffscreenContext(std::make_unique<Impl>(made->display, made->context));
}

bool OffscreenContext::makeCurrent() {
    eglBindAPI(EGL_OPENGL_API);
    return eglMakeCurrent(m_impl->display, EGL_NO_SURFACE, EGL_NO_SURFACE, m_impl->context) == EGL_TRUE;
}

void OffscreenContext::doneCurrent() {
    m_impl->release();
}

} // namespace posewire::render
