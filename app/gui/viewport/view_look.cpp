// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/viewport/view_look.h"

#include "app/gui/models/text.h"
#include "app/gui/theme/theme.h"
#include "app/gui/theme/words.h"
#include "app/gui/viewport/overlays.h"

#include <QJsonArray>
#include <QRect>

#include <algorithm>
#include <cmath>
#include <utility>

namespace posewire::gui {

namespace {

/// Logical pixels between two panes.
constexpr int kGap = 2;

constexpr std::array kUsualViews{render::StandardView::ThreeQuarter, render::StandardView::Front,
                                 render::StandardView::Left, render::StandardView::Top};

constexpr double kNumbersApart = 64;    ///< logical pixels between two numbers, at the least
constexpr float kLevel = 0.02F;         ///< radians: a view along the floor
constexpr int kMostNumbers = 14;        ///< on each side of the origin
constexpr float kFarthestNumber = 5.0F; ///< of what is numbered, times the camera's distance

double metresPerPixel(const SceneFrame& frame) {
    const double height = frame.height / static_cast<double>(frame.pixelRatio);
    return 2.0 * static_cast<double>(frame.camera.distance) *
           std::tan(0.5 * static_cast<double>(frame.camera.verticalFov)) / height;
}

QString metres(double value, double step) {
    return tr("%1 m").arg(fixed(value, step < 1 ? 1 : 0));
}

/// The part of the picture that a figure takes, −1 … 1 in both directions.
QRectF roomOf(const Figure& figure, const SceneFrame& frame) {
    constexpr float kFlesh = 0.15F; // metres about the origins
    render::Bounds bounds = figure.bounds;
    bounds.min -= glm::vec3(kFlesh);
    bounds.max += glm::vec3(kFlesh);
    const ScreenBox box = screenBox(frame.camera, std::span(&bounds, 1), aspectOf(frame));
    if (box.least.x > box.most.x) {
        return {}; // all of it is behind the eye
    }
    return {QPointF(static_cast<double>(box.least.x), static_cast<double>(box.least.y)),
            QPointF(static_cast<double>(box.most.x), static_cast<double>(box.most.y))};
}

/// A number on the floor, and where it appears, in logical pixels.
struct FloorNumber {
    SceneText text;
    QPointF screen;
    float away; ///< from the eye
};

void addCandidate(SceneText text, std::span<const QRectF> rooms, const SceneFrame& frame,
                  std::vector<FloorNumber>& numbers) {
    const auto place = frame.camera.project(text.position, aspectOf(frame));
    const QPointF at =
        place ? QPointF(static_cast<double>(place->x), static_cast<double>(place->y)) : QPointF();
    if (!place || std::ranges::any_of(rooms, [&](const QRectF& room) { return room.contains(at); })) {
        return;
    }
    const double half = 0.5 / static_cast<double>(frame.pixelRatio);
    const float away = glm::distance(text.position, frame.camera.eye());
    numbers.push_back({std::move(text), {at.x() * frame.width * half, at.y() * frame.height * half}, away});
}

/// "x 1 m" where the axis crosses the lines of the grid; toward the horizon only as many as stand apart.
void addFloorNumbers(SceneFrame& frame) {
    constexpr double kAbove = 18; // logical pixels
    std::vector<QRectF> rooms;
    for (const Figure& figure : frame.figures) {
        if (figure.body != nullptr && !figure.bounds.isEmpty()) {
            rooms.push_back(roomOf(figure, frame));
        }
    }
    const double step = std::max(1.0, scaleStep(metresPerPixel(frame), kNumbersApart));
    std::vector<FloorNumber> numbers;
    for (const auto& [name, axis] : {std::pair{tr("x"), 0}, std::pair{tr("y"), 1}}) {
        for (int i = -kMostNumbers; i <= kMostNumbers; ++i) {
            glm::vec3 place(0.0F);
            place[axis] = static_cast<float>(i * step);
            const bool isNear =
                glm::distance(place, frame.camera.target) < kFarthestNumber * frame.camera.distance;
            if (i != 0 && isNear) {
                const QString words = name + QLatin1Char(' ') + metres(i * step, step);
                addCandidate({place, words, theme().dim, true}, rooms, frame, numbers);
            }
        }
    }
    std::ranges::stable_sort(numbers, {}, &FloorNumber::away);
    std::vector<QPointF> taken;
    for (FloorNumber& number : numbers) {
        const auto isTooNear = [&number](const QPointF& other) {
            return std::abs(number.screen.x() - other.x()) < kNumbersApart &&
                   std::abs(number.screen.y() - other.y()) < kAbove;
        };
        if (std::ranges::none_of(taken, isTooNear)) {
            taken.push_back(number.screen);
            frame.texts.push_back(std::move(number.text));
        }
    }
}

/// The axis of the world that goes across a picture, and whether it grows to the right; no name if none does.
std::pair<QString, double> acrossOf(const render::Camera& camera) {
    constexpr float kAlong = 0.9995F; // cosine of 2°
    const glm::vec3 right = camera.right();
    for (const auto& [name, share] : {std::pair{tr("x"), right.x}, std::pair{tr("y"), right.y}}) {
        if (std::abs(share) > kAlong) {
            return {name + QLatin1Char(' '), share > 0 ? 1.0 : -1.0};
        }
    }
    return {};
}

/// 0 is the origin of the world. Numbers are those of its axis; where the picture is oblique to both, they
/// are distances, without a sign.
void addRules(SceneFrame& frame) {
    const render::Camera& camera = frame.camera;
    const double pixel = metresPerPixel(frame);
    const double step = scaleStep(pixel, kNumbersApart);
    const double halfHeight = pixel * frame.height / static_cast<double>(frame.pixelRatio) / 2;
    const double halfWidth = halfHeight * static_cast<double>(aspectOf(frame));
    const glm::vec3 right = camera.right();
    const double middle = static_cast<double>(glm::dot(camera.target, right));
    const glm::vec3 depth = camera.target - static_cast<float>(middle) * right;
    const auto at = [&](double along, double height) {
        glm::vec3 place = depth + static_cast<float>(along) * right;
        place.z = static_cast<float>(height);
        return place;
    };
    const glm::vec4 ink = inkOf(theme().dim, 0.8F);
    const double tick = 6 * pixel;
    const auto line = [&](const glm::vec3& from, const glm::vec3& to) {
        frame.lines.push_back({from, to, ink, 1.2F, 1.0F});
    };
    line(at(middle - 1.2 * halfWidth, 0), at(middle + 1.2 * halfWidth, 0));
    const auto [axis, sign] = acrossOf(camera);
    for (double along = std::ceil((middle - halfWidth) / step) * step; along < middle + halfWidth;
         along += step) {
        line(at(along, 0), at(along, -tick));
        const double value = sign == 0 ? std::abs(along) : sign * along;
        frame.texts.push_back(
            {at(along - 7 * pixel, -3 * tick), axis + metres(value, step), theme().dim, true});
    }
    constexpr double kEdge = 18; // logical pixels
    const double edge = middle - halfWidth + kEdge * pixel;
    const double top = static_cast<double>(camera.target.z) + halfHeight;
    line(at(edge, 0), at(edge, top));
    for (double height = step; height < top; height += step) {
        line(at(edge, height), at(edge + tick, height));
        frame.texts.push_back(
            {at(edge + tick, height), tr("z") + QLatin1Char(' ') + metres(height, step), theme().dim, true});
    }
}

} // namespace

void ViewPanes::split(int count, float heading) {
    m_count = count >= kMost ? kMost : std::clamp(count, 1, 2);
    for (int pane = 1; pane < m_count; ++pane) {
        const auto index = static_cast<std::size_t>(pane);
        if (std::exchange(m_wasShown[index], true)) {
            continue;
        }
        CameraMotion& motion = m_motions[index];
        motion.face(kUsualViews[index]);
        motion.turn(heading);
        motion.setProjection(render::Projection::Orthographic);
    }
    activate(m_active);
}

QRect ViewPanes::place(int pane) const {
    if (m_count == 1) {
        return {{}, m_view};
    }
    const int width = std::max(1, (m_view.width() - kGap) / 2);
    const int height = m_count == 2 ? m_view.height() : std::max(1, (m_view.height() - kGap) / 2);
    return {(pane % 2) * (m_view.width() - width), (pane / 2) * (m_view.height() - height), width, height};
}

float ViewPanes::aspect() const {
    return static_cast<float>(std::max(1, place().width())) /
           static_cast<float>(std::max(1, place().height()));
}

int ViewPanes::paneAt(const QPointF& point) const {
    for (int pane = 0; pane < m_count; ++pane) {
        if (place(pane).contains(point.toPoint())) {
            return pane;
        }
    }
    return m_active;
}

QString ViewPanes::name(int pane) const {
    const CameraMotion& motion = m_motions[static_cast<std::size_t>(pane)];
    const bool isFlat = motion.camera().projection == render::Projection::Orthographic;
    const std::array names{tr("Front"), tr("Back"), tr("Left side"), tr("Right side"), tr("Top")};
    const auto view = static_cast<std::size_t>(
        motion.standardView().value_or(render::StandardView::ThreeQuarter)); // which has no name of its own
    return view < names.size() ? names[view] : isFlat ? tr("Orthographic") : tr("Perspective");
}

QJsonObject ViewPanes::state() const {
    QJsonArray cameras;
    for (int pane = 0; pane < kMost; ++pane) {
        const auto index = static_cast<std::size_t>(pane);
        cameras.append(m_wasShown[index] ? stateOf(m_motions[index]) : QJsonObject());
    }
    return {{"count", m_count}, {"active", m_active}, {"cameras", cameras}};
}

void ViewPanes::restoreState(const QJsonObject& state) {
    const QJsonArray cameras = state["cameras"].toArray();
    for (int pane = 0; pane < kMost; ++pane) {
        const auto index = static_cast<std::size_t>(pane);
        const QJsonObject camera = cameras.at(pane).toObject();
        if (!camera.isEmpty()) {
            m_wasShown[index] = true;
            restore(m_motions[index], camera);
        }
    }
    split(state["count"].toInt(m_count), 0);
    activate(state["active"].toInt(m_active));
}

void ViewLook::fill(SceneBuilder& builder, double seconds, SceneFrame& frame) {
    builder.setWardrobe(wardrobe);
    builder.build(axes, overlays, frame);
    aim(panes.motion(), seconds, frame);
}

void ViewLook::fillPanes(SceneBuilder& builder, double seconds, SceneFrame& frame) {
    builder.setWardrobe(wardrobe);
    builder.build(axes, overlays, frame);
    std::vector<SceneFrame> all(static_cast<std::size_t>(panes.count()), frame);
    const auto pixels = [&](int logical) {
        return static_cast<int>(std::lround(static_cast<float>(logical) * frame.pixelRatio));
    };
    for (int pane = 0; pane < panes.count(); ++pane) {
        SceneFrame& one = all[static_cast<std::size_t>(pane)];
        const QRect place = panes.place(pane);
        one.x = pixels(place.x());
        one.y = pixels(place.y());
        one.width = std::max(1, pixels(place.width()));
        one.height = std::max(1, pixels(place.height()));
        aim(panes.motionOf(pane), seconds, one);
    }
    frame.camera = panes.motion().camera();
    frame.panes = std::move(all);
}

bool ViewLook::isGliding() const {
    bool isAny = false;
    for (int pane = 0; pane < panes.count(); ++pane) {
        isAny = isAny || panes.motionOf(pane).isGliding();
    }
    return isAny;
}

void ViewLook::aim(CameraMotion& motion, double seconds, SceneFrame& frame) const {
    motion.follow(boxesOf(frame), aspectOf(frame), seconds);
    frame.camera = motion.camera();
    sizeAxes(frame);
    if (hasScale) {
        addFloorScale(frame);
    }
}

render::Bounds paddedBounds(const Figure& figure) {
    constexpr float kMargin = 0.22F; // metres
    render::Bounds bounds = figure.bounds;
    bounds.min -= glm::vec3(kMargin, kMargin, 0.5F * kMargin);
    bounds.max += glm::vec3(kMargin, kMargin, 1.6F * kMargin);
    return bounds;
}

std::vector<render::Bounds> boxesOf(const SceneFrame& frame) {
    std::vector<render::Bounds> boxes;
    for (const Figure& figure : frame.figures) {
        if (!figure.bounds.isEmpty()) {
            boxes.push_back(paddedBounds(figure));
        }
    }
    return boxes;
}

float aspectOf(const SceneFrame& frame) {
    return static_cast<float>(frame.width) / static_cast<float>(frame.height);
}

double scaleStep(double metresPerPixel, double pixels) {
    const double least = metresPerPixel * pixels;
    double decade = 0.1;
    while (decade * 10 <= least) {
        decade *= 10;
    }
    for (const double step : {decade, 2 * decade, 5 * decade}) {
        if (step >= least) {
            return step;
        }
    }
    return 10 * decade;
}

void addFloorScale(SceneFrame& frame) {
    const bool isLevel =
        frame.camera.projection == render::Projection::Orthographic && std::abs(frame.camera.pitch) < kLevel;
    if (isLevel) {
        addRules(frame);
    } else {
        addFloorNumbers(frame);
    }
}

} // namespace posewire::gui
