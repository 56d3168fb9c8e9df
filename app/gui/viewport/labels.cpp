// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/viewport/labels.h"

#include "app/gui/models/shown_character.h"
#include "app/gui/models/text.h"
#include "app/gui/viewport/camera_motion.h"
#include "app/gui/viewport/picking.h"
#include "core/model/session/roster.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

namespace posewire::gui {
namespace {

/// Nothing where the head is behind the eye.
std::optional<ViewportLabel> labelOf(const Figure& figure, const render::Camera& camera,
                                     model::SessionView& session, const QSizeF& size) {
    constexpr float kAboveHead = 0.05F; // metres, and the head below that
    constexpr float kHeadHeight = 0.3F;
    const glm::vec3 top = figure.labelPosition - glm::vec3(0, 0, kAboveHead);
    const auto anchor = camera.project(figure.labelPosition, aspectOf(size));
    const auto crown = camera.project(top, aspectOf(size));
    const auto chin = camera.project(top - kHeadHeight * camera.up(), aspectOf(size));
    if (!anchor || !crown || !chin) {
        return std::nullopt;
    }
    ViewportLabel label;
    label.key = figure.key;
    label.anchor = pointerAt(*anchor, size);
    const QPointF above = pointerAt(*crown, size);
    const qreal height = std::abs(pointerAt(*chin, size).y() - above.y());
    label.head = QRectF(above.x() - 0.4 * height, above.y(), 0.8 * height, height);
    label.depth = glm::dot(figure.labelPosition - camera.eye(), camera.forward());
    label.mark = {QColor::fromRgbF(figure.look.colour.r, figure.look.colour.g, figure.look.colour.b),
                  figure.key.character};
    label.name = nameApart(session, figure.key);
    label.state = characterHealth(session, figure.key);
    label.isSelected = session.roster().isSelected(figure.key);
    return label;
}

} // namespace

std::vector<ViewportLabel> labelsOf(const SceneFrame& frame, model::SessionView& session,
                                    const QSizeF& size) {
    std::vector<ViewportLabel> labels;
    for (std::size_t i = 0; i < frame.figures.size(); ++i) {
        const Figure& figure = frame.figures[i];
        if (auto label = labelOf(figure, frame.camera, session, size)) {
            label->isBehind = figure.body != nullptr && isBehindAnother(frame, i, label->head.center(), size);
            labels.push_back(std::move(*label));
        }
    }
    return labels;
}

std::vector<ViewportText> textsOf(const SceneFrame& frame, const QSizeF& size) {
    std::vector<std::pair<std::pair<bool, float>, ViewportText>> all;
    for (const SceneText& text : frame.texts) {
        if (const auto place = frame.camera.project(text.position, aspectOf(size))) {
            const float depth = glm::dot(text.position - frame.camera.eye(), frame.camera.forward());
            all.push_back({{text.isScale, depth}, {pointerAt(*place, size), text.text, text.colour}});
        }
    }
    std::ranges::stable_sort(all, {}, [](const auto& one) { return one.first; });
    std::vector<ViewportText> texts;
    for (auto& [order, text] : all) {
        texts.push_back(std::move(text));
    }
    return texts;
}

} // namespace posewire::gui
