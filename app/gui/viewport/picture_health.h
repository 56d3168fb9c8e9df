// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/gui/base/program_state.h"
#include "app/gui/viewport/presenter.h"

namespace posewire::gui {

/// What the statistics say of the viewport's pictures: on which step of leaving things out they are, and why.
/// `hardwareFailure` says why the processor draws where there was hardware; empty for none.
[[nodiscard]] PictureHealth pictureHealthOf(const PictureLoad& load, const QString& hardwareFailure = {});

} // namespace posewire::gui
