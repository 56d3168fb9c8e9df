// SPDX-License-Identifier: MIT
#pragma once

#include "render/gl/framebuffer.h"
#include "render/passes/frame.h"

#include <optional>

namespace posewire::render {

/// A part of the picture that is drawn once and copied while it stays the same.
class Backdrop {
public:
    /// Leaves it in the framebuffer `target`, which stays bound. `draw` is called with a framebuffer of the
    /// viewport's size bound where what is kept is of another block; where the driver refuses one, with the
    /// target.
    template <typename Draw>
    void show(const FrameBlock& block, unsigned target, Draw draw) {
        const bool isKept = isOf(block);
        if (!isKept && !renew(block)) {
            bind(target);
            draw();
            return;
        }
        if (!isKept) {
            draw();
        }
        copyTo(target);
    }

private:
    [[nodiscard]] bool isOf(const FrameBlock& block) const;
    /// Binds a framebuffer for it; false where there is none.
    bool renew(const FrameBlock& block);
    static void bind(unsigned target);
    void copyTo(unsigned target) const;

    gl::Texture m_colour;
    gl::Framebuffer m_framebuffer;
    std::optional<FrameBlock> m_block;
};

/// What the background alone depends on, and what it depends on together with the floor without shadows.
FrameBlock backgroundBlock(const FrameBlock& block);
FrameBlock backdropBlock(const FrameBlock& block);

} // namespace posewire::render
