// SPDX-License-Identifier: MIT
#pragma once

#include "render/image.h"

#include <string>

namespace posewire::render::test {

/// Fails the running test unless the picture is that of tests/baselines/<name>.png: at most 0.05 % of its
/// pixels may be off by more than 2/255, which is what processors without AVX were found to differ by. On
/// failure <name>.actual.png and, where the sizes agree, <name>.diff.png lie in the build folder's
/// tests/render/pictures; a missing baseline is a failure too. POSEWIRE_UPDATE_BASELINES=1 in the environment
/// rewrites the baseline instead.
void expectMatchesBaseline(const Image& image, const std::string& name);

/// Pins what Mesa's pictures depend on, for programs that are started without ctest. Before the first
/// context.
void useSoftwareOpenGl();

} // namespace posewire::render::test
