// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/viewport/label_layout.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <tuple>
#include <utility>

namespace posewire::gui {

namespace {

constexpr qreal kApart = 3;
/// From the edge of the picture.
constexpr qreal kLabelEdge = 2;
/// A plate farther from its head than this has a line to it.
constexpr qreal kLeader = 6;
/// What may lie this much deeper is as near, metres.
constexpr double kAsNear = 0.05;
/// A form that shows more must have this much more room to come back.
constexpr qreal kToSpare = 6;

/// In heights of a plate: how far from its head a label may be.
constexpr qreal kMostWhole = 2.4;
constexpr qreal kMostNamed = 3.2;
constexpr qreal kMostBrief = 5;
/// Only this many labels are placed as text. Any others appear as marks, since they would hardly fit.
constexpr int kMostTried = 100;

struct Candidate {
    QRectF plate;
    QPointF offset;
    qreal cost = 0;
};

qreal distanceTo(const QRectF& plate, const QPointF& point) {
    const qreal x = std::max({plate.left() - point.x(), point.x() - plate.right(), 0.0});
    const qreal y = std::max({plate.top() - point.y(), point.y() - plate.bottom(), 0.0});
    return std::hypot(x, y);
}

/// The share of a line at which it comes into a box; 1 where it never does.
qreal entryInto(const QRectF& box, const QLineF& line) {
    qreal in = 0;
    qreal out = 1;
    const auto cut = [&](qreal from, qreal way, qreal low, qreal high) {
        if (way == 0) {
            out = from < low || from > high ? -1 : out;
            return;
        }
        const qreal first = (low - from) / way;
        const qreal second = (high - from) / way;
        in = std::max(in, std::min(first, second));
        out = std::min(out, std::max(first, second));
    };
    cut(line.x1(), line.dx(), box.left(), box.right());
    cut(line.y1(), line.dy(), box.top(), box.bottom());
    return in <= out ? in : 1;
}

/// From what a plate belongs to: the point above a head, or the head, which is large where the eye is near.
qreal awayFrom(const LabelPlace& place, const QRectF& plate) {
    const QRectF& head = place.head;
    qreal away = distanceTo(plate, place.anchor);
    for (const QRectF& box : {head, place.arms[0], place.arms[1]}) {
        const qreal x = std::max({plate.left() - box.right(), box.left() - plate.right(), 0.0});
        const qreal y = std::max({plate.top() - box.bottom(), box.top() - plate.bottom(), 0.0});
        away = box.isEmpty() ? away : std::min(away, std::hypot(x, y));
    }
    return away;
}

QRectF plateAt(const LabelPlace& place, const QSizeF& size, const QPointF& offset, const QRectF& view) {
    const QPointF middle = place.anchor + offset;
    QRectF plate(std::round(middle.x() - size.width() / 2), std::round(middle.y() - size.height()),
                 std::ceil(size.width()), std::ceil(size.height()));
    plate.moveLeft(std::clamp(plate.left(), view.left() + kLabelEdge,
                              std::max(view.left() + kLabelEdge, view.right() - kLabelEdge - plate.width())));
    plate.moveTop(std::clamp(plate.top(), view.top() + kLabelEdge,
                             std::max(view.top() + kLabelEdge, view.bottom() - kLabelEdge - plate.height())));
    return plate;
}

/// How far from its head, above all else, and how far aside.
qreal costOf(const LabelPlace& place, const QRectF& plate) {
    return distanceTo(plate, place.anchor) + std::abs(plate.center().x() - place.anchor.x()) / 4;
}

/// Above the head and aside, row by row, then beside it.
std::vector<Candidate> candidatesOf(const LabelPlace& place, const QSizeF& size, qreal most,
                                    const QRectF& view) {
    const qreal row = size.height() + kApart;
    std::vector<Candidate> all;
    const auto add = [&](const QPointF& offset) {
        const QRectF plate = plateAt(place, size, offset, view);
        if (awayFrom(place, plate) <= most * size.height()) {
            all.push_back({plate, offset, costOf(place, plate)});
        }
    };
    const auto addRows = [&](qreal from) {
        for (int up = 0; up <= static_cast<int>(most) + 1; ++up) {
            for (const qreal aside : {0.0, -0.25, 0.25, -0.5, 0.5, -0.75, 0.75}) {
                add({aside * size.width(), from - up * row});
            }
        }
    };
    addRows(0);
    for (const QRectF& arm : place.arms) {
        if (!arm.isEmpty() && arm.top() < place.anchor.y()) {
            addRows(arm.top() - place.anchor.y() - kApart);
        }
    }
    const qreal beside = size.width() / 2 + place.head.width() / 2 + kApart;
    const qreal level = place.head.center().y() - place.anchor.y() + size.height() / 2;
    const auto addBeside = [&](qreal down) {
        add({-beside, level + down});
        add({beside, level + down});
    };
    addBeside(0);
    std::ranges::stable_sort(all, {}, &Candidate::cost);
    addBeside(row / 2); // where all else is covered
    addBeside(row);
    return all;
}

/// A grid over the picture that finds overlapping rectangles without comparing all of them. A rectangle
/// outside the picture belongs to the nearest square.
class Crowd {
public:
    explicit Crowd(const QRectF& view) : m_view(view) {}

    void add(const QRectF& rect, std::size_t which = 0) {
        static_cast<void>(isAnySquare(rect, [&](std::size_t square) {
            m_squares[square].push_back({rect, which});
            return false;
        }));
    }
    /// True if `room` overlaps a rectangle for which `isMeant(which)` returns true.
    template <class Predicate>
    [[nodiscard]] bool isAnyIn(const QRectF& room, Predicate isMeant) const {
        return isAnySquare(room, [&](std::size_t square) {
            return std::ranges::any_of(m_squares[square], [&](const auto& one) {
                return one.first.intersects(room) && isMeant(one.second);
            });
        });
    }

private:
    static constexpr std::size_t kSide = 16; ///< squares
    static std::size_t squareAt(qreal place, qreal length) {
        return static_cast<std::size_t>(std::clamp(kSide * place / std::max(length, 1.0), 0.0, kSide - 1.0));
    }
    /// True if `isMeant(square)` returns true for any square that the rectangle touches.
    template <class Predicate>
    bool isAnySquare(const QRectF& rect, Predicate isMeant) const {
        const std::size_t right = squareAt(rect.right() - m_view.left(), m_view.width());
        const std::size_t bottom = squareAt(rect.bottom() - m_view.top(), m_view.height());
        for (std::size_t y = squareAt(rect.top() - m_view.top(), m_view.height()); y <= bottom; ++y) {
            for (std::size_t x = squareAt(rect.left() - m_view.left(), m_view.width()); x <= right; ++x) {
                if (isMeant(y * kSide + x)) {
                    return true;
                }
            }
        }
        return false;
    }

    QRectF m_view;
    std::array<std::vector<std::pair<QRectF, std::size_t>>, kSide * kSide> m_squares;
};

class Placing {
public:
    Placing(std::span<const LabelPlace> places, const QRectF& view, const std::vector<QRectF>& taken)
        : m_places(places), m_view(view), m_heads(view), m_taken(view) {
        for (std::size_t i = 0; i < places.size(); ++i) {
            m_heads.add(places[i].head, i);
            for (const QRectF& arm : places[i].arms) {
                if (!arm.isEmpty()) {
                    m_heads.add(arm, i);
                }
            }
        }
        std::ranges::for_each(taken, [this](const QRectF& room) { m_taken.add(room); });
    }

    PlacedLabel place(std::size_t which) {
        const LabelPlace& own = m_places[which];
        if (!m_view.contains(own.anchor)) {
            return {};
        }
        const std::array forms{std::tuple(LabelForm::Whole, own.whole, kMostWhole),
                               std::tuple(LabelForm::Named, own.named, kMostNamed),
                               std::tuple(LabelForm::Brief, own.brief, kMostBrief)};
        ++m_tried;
        std::optional<PlacedLabel> best;
        for (const auto& [form, size, most] : forms) { // a shorter form is better than covering a head
            const bool isTried = !size.isEmpty() && m_tried <= kMostTried;
            const std::optional<PlacedLabel> found = isTried ? find(which, form, size, most) : std::nullopt;
            best = best ? best : found;
            if (found && !isOnHead(found->plate, which, false)) {
                best = found;
                break;
            }
        }
        if (best) {
            m_taken.add(best->plate);
            return *best;
        }
        const QRectF mark(own.anchor - QPointF(4, 4), QSizeF(8, 8));
        const bool isBehind = isOnHead(mark, which, true) || isTaken(mark);
        return {QRectF(own.anchor, QSizeF()), isBehind ? LabelForm::None : LabelForm::Mark, {}};
    }

private:
    /// Prefers the best place that covers no head. Returns nothing if no place is free.
    std::optional<PlacedLabel> find(std::size_t which, LabelForm form, const QSizeF& size, qreal most) const {
        const LabelPlace& own = m_places[which];
        const std::optional<Candidate> kept = keptPlace(which, form, size);
        const qreal spare = kept || (own.before && own.before->form > form) ? kToSpare : 0;
        std::optional<PlacedLabel> second;
        for (const Candidate& one : candidatesOf(own, size, most, m_view)) {
            if (kept && one.cost > kept->cost - size.height()) {
                break;
            }
            if (!isFree(one.plate, which, spare)) {
                continue;
            }
            if (!isOnHead(one.plate, which, false)) {
                return PlacedLabel{one.plate, form, one.offset};
            }
            second = second ? second : std::optional(PlacedLabel{one.plate, form, one.offset});
        }
        return kept ? PlacedLabel{kept->plate, form, kept->offset} : second;
    }
    /// Where it was in the picture before, if it may be there again.
    [[nodiscard]] std::optional<Candidate> keptPlace(std::size_t which, LabelForm form,
                                                     const QSizeF& size) const {
        const LabelPlace& own = m_places[which];
        if (!own.before || own.before->form != form) {
            return std::nullopt;
        }
        const QRectF plate = plateAt(own, size, own.before->offset, m_view);
        const bool isGood = isFree(plate, which, 0) && !isOnHead(plate, which, false);
        return isGood ? std::optional(Candidate{plate, own.before->offset, costOf(own, plate)})
                      : std::nullopt;
    }
    [[nodiscard]] bool isFree(const QRectF& plate, std::size_t which, qreal spare) const {
        const QRectF wide = plate.adjusted(-kApart - spare, -kApart, kApart + spare, kApart);
        const LabelPlace& own = m_places[which];
        return !isTaken(wide) && !own.head.intersects(plate) && !own.arms[0].intersects(plate) &&
               !own.arms[1].intersects(plate) && !isOnHead(plate, which, true);
    }
    [[nodiscard]] bool isTaken(const QRectF& room) const {
        return m_taken.isAnyIn(room, [](std::size_t) { return true; });
    }
    /// On the head of somebody else; `isNearer`: only of somebody as near or nearer.
    [[nodiscard]] bool isOnHead(const QRectF& plate, std::size_t which, bool isNearer) const {
        return m_heads.isAnyIn(plate, [&](std::size_t other) {
            return other != which && (!isNearer || m_places[other].depth <= m_places[which].depth + kAsNear);
        });
    }

    std::span<const LabelPlace> m_places;
    QRectF m_view;
    Crowd m_heads;
    Crowd m_taken;
    int m_tried = 0;
};

} // namespace

std::vector<PlacedLabel> placeLabels(std::span<const LabelPlace> places, const QRectF& view,
                                     const std::vector<QRectF>& taken) {
    std::vector<std::size_t> order(places.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::ranges::stable_sort(
        order, {}, [&](std::size_t which) { return std::pair(-places[which].weight, places[which].depth); });
    Placing placing(places, view, taken);
    std::vector<PlacedLabel> placed(places.size());
    for (const std::size_t which : order) {
        placed[which] = placing.place(which);
    }
    return placed;
}

std::optional<QLineF> leaderOf(const PlacedLabel& label, std::span<const LabelPlace> places,
                               std::size_t which) {
    const LabelPlace& place = places[which];
    const bool isAbove = label.plate.bottom() <= place.anchor.y() + kApart;
    const bool isLeft = label.plate.center().x() < place.head.center().x();
    const QPointF end =
        isAbove ? place.anchor
                : QPointF(isLeft ? place.head.left() : place.head.right(), place.head.center().y());
    if (label.form > LabelForm::Brief || distanceTo(label.plate, end) <= kLeader) {
        return std::nullopt;
    }
    QLineF line(std::clamp(end.x(), label.plate.left() + kLeader, label.plate.right() - kLeader),
                std::clamp(end.y(), label.plate.top(), label.plate.bottom()), end.x(), end.y());
    qreal seen = 1;
    for (const LabelPlace& other : places) {
        seen = other.depth + kAsNear < place.depth ? std::min(seen, entryInto(other.head, line)) : seen;
    }
    line.setP2(line.pointAt(seen));
    return line.length() > 1 ? std::optional(line) : std::nullopt;
}

QString initialsOf(const QString& name) {
    QString initials;
    int letters = 0;
    for (const QString& word : name.split(QLatin1Char(' '), Qt::SkipEmptyParts)) {
        const bool isNumber = word.size() <= 3 && word[0].isDigit();
        if (isNumber) {
            initials += word;
        } else if (letters < 2 && word[0] != u'·' && word[0] != u':') { // what only tells it from others
            initials += word.left(word[0].isHighSurrogate() ? 2 : 1).toUpper();
            ++letters;
        }
    }
    return initials.left(5);
}

} // namespace posewire::gui
