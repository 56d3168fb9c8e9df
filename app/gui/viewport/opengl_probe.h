// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace posewire::gui {

/// Whether windows can be drawn by graphics hardware: a platform on which QOpenGLWidget works at all (it
/// crashes on the others), OpenGL 3.3 or newer, and not drawn by the processor.
[[nodiscard]] bool hasHardwareOpenGl();

} // namespace posewire::gui
