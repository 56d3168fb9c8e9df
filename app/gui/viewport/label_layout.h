// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QLineF>
#include <QPointF>
#include <QRectF>
#include <QSizeF>
#include <QString>

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace posewire::gui {

enum class LabelForm : std::uint8_t {
    Whole, ///< name and state
    Named, ///< the name, without its middle where it is long, and the symbol of the state
    Brief, ///< initials, and the symbol of the state
    Mark,  ///< the mark alone, above the head
    None,  ///< nothing: the head is out of sight, behind a nearer one or under a label or button
};

struct PlacedLabel {
    QRectF plate;
    LabelForm form = LabelForm::None;
    QPointF offset; ///< of the plate's lower middle from the head
};

/// A head in the picture that is to have a label. Pixels of the widget.
struct LabelPlace {
    QPointF anchor; ///< just above the head
    QRectF head;
    double depth = 0; ///< metres from the eye
    int weight = 0;   ///< the heaviest is served first, of equal ones the nearest
    QSizeF whole{};
    QSizeF brief{};
    std::optional<PlacedLabel> before{}; ///< in the picture before, so that nothing flickers
    QSizeF named{};                      ///< empty if the brief form shows as much
    std::array<QRectF, 2> arms{};        ///< that are raised: as little to be covered as a head
};

/// Finds a place for each label by its head: nowhere on another, on what is `taken`, on its own head or
/// that of somebody nearer, and rather not on any head. Where there is no room for all text, the short form.
/// In the order given.
[[nodiscard]] std::vector<PlacedLabel> placeLabels(std::span<const LabelPlace> places, const QRectF& view,
                                                   const std::vector<QRectF>& taken);

/// The line from a plate to the head of the place at `which`, cut off at the first head in front of it. Empty
/// if the plate is close enough without one.
[[nodiscard]] std::optional<QLineF> leaderOf(const PlacedLabel& label, std::span<const LabelPlace> places,
                                             std::size_t which);

/// "ML", of "Mira Lindqvist"; "ML2", of "Mira Lindqvist 2"; "C7", of "Character 7".
[[nodiscard]] QString initialsOf(const QString& name);

} // namespace posewire::gui
