// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/viewport/opengl_probe.h"

#include "render/renderer.h"

#include <QGuiApplication>
#include <QOffscreenSurface>
#include <QOpenGLContext>
#include <QOpenGLFunctions>

#include <algorithm>
#include <array>
#include <string>

namespace posewire::gui {

namespace {

constexpr int kMajorVersion = 3;
constexpr int kMinorVersion = 3;

std::string rendererName(QOpenGLContext& context) {
    constexpr unsigned kGlRenderer = 0x1F01;
    const auto* name = context.functions()->glGetString(kGlRenderer);
    return name == nullptr ? std::string() : reinterpret_cast<const char*>(name);
}

} // namespace

bool hasHardwareOpenGl() {
    constexpr std::array kPlatforms{"xcb", "wayland", "wayland-egl", "windows", "cocoa"};
    const QString platform = QGuiApplication::platformName();
    if (std::ranges::none_of(kPlatforms, [&](const char* name) { return platform == QLatin1String(name); })) {
        return false;
    }
    QSurfaceFormat format;
    format.setVersion(kMajorVersion, kMinorVersion);
    format.setProfile(QSurfaceFormat::CoreProfile);
    QOpenGLContext context;
    context.setFormat(format);
    if (!context.create()) {
        return false;
    }
    QOffscreenSurface surface;
    surface.setFormat(context.format());
    surface.create();
    if (!surface.isValid() || !context.makeCurrent(&surface)) {
        return false;
    }
    const bool isNewEnough = context.format().version() >= qMakePair(kMajorVersion, kMinorVersion);
    const bool isHardware = isNewEnough && !render::isSoftwareRenderer(rendererName(context));
    context.doneCurrent();
    return isHardware;
}

} // namespace posewire::gui
