// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/gui/viewport/scene_frame.h"
#include "core/model/session/session_view.h"

#include <map>
#include <memory>

namespace posewire::gui {

/// The fitted mesh of every character, made once for each null pose it sends.
class FigureMeshes {
public:
    explicit FigureMeshes(render::Detail detail) : m_detail(detail) {}

    [[nodiscard]] std::shared_ptr<const FigureMesh> of(model::SessionView& session,
                                                       const model::CharacterKey& key);

private:
    struct Entry {
        render::NullPose performer{};
        std::shared_ptr<const FigureMesh> mesh;
    };

    [[nodiscard]] const render::SkinnedMesh& mannequin();
    [[nodiscard]] std::shared_ptr<const FigureMesh> fitted(const render::NullPose& performer);

    render::Detail m_detail;
    std::unique_ptr<const render::SkinnedMesh> m_mannequin;
    std::map<model::CharacterKey, Entry> m_entries;
};

} // namespace posewire::gui
