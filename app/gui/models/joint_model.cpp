// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/models/joint_model.h"

#include "app/gui/models/shown_character.h"
#include "app/gui/models/text.h"
#include "app/gui/theme/words.h"
#include "core/model/body/character_pose.h"
#include "core/model/body/reference_body.h"
#include "core/model/session/messages.h"
#include "core/model/session/roster.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace posewire::gui {

namespace {

using model::BodyAngles;
using model::kBodyJointCount;
using model::kDegreesPerRadian;

/// The order of the rows: the spine, then each joint of the right side with that of the left.
constexpr std::array<std::size_t, kBodyJointCount> kJointOrder{0,  1, 2,  3,  4,  5,  6,  10, 7,  11, 8,
                                                               12, 9, 13, 14, 18, 15, 19, 16, 20, 17, 21};
constexpr std::size_t kSpineJoints = 6;
/// The first row of each pair from the shoulder girdle down.
enum Pair : std::size_t { kGirdle = 6, kElbow = 10, kWrist = 12, kAnkle = 18, kBallOfFoot = 20 };

QString degrees(double radians) {
    return std::isfinite(radians) ? fixed(radians * kDegreesPerRadian, 1) : dash();
}

QString rangeText(const std::optional<model::AngleRange>& range, int decimals) {
    return !range || range->isEmpty() ? dash()
                                      : tr("%1 to %2")
                                            .arg(fixed(range->least * kDegreesPerRadian, decimals),
                                                 fixed(range->most * kDegreesPerRadian, decimals));
}

double component(const Eigen::Vector3d& angles, std::size_t axis) {
    return angles[static_cast<Eigen::Index>(axis)];
}

/// The motion that a positive angle is, and its opposite.
QString motionName(int row, std::size_t axis) {
    const auto pair = static_cast<std::size_t>(row) / 2 * 2;
    const std::array usual{tr("Abduction / adduction"), tr("Internal / external rotation"),
                           tr("Flexion / extension")};
    if (static_cast<std::size_t>(row) < kSpineJoints) {
        const std::array spine{tr("Bending right / left"), tr("Rotation left / right"), usual[2]};
        return spine[axis];
    }
    const std::array girdle{tr("Elevation / depression"), tr("Protraction / retraction"), usual[2]};
    const QString pronation = tr("Pronation / supination");
    switch (pair) {
    case kGirdle:
        return girdle[axis];
    case kElbow:
        return axis == 1 ? pronation : usual[axis];
    case kWrist:
        return axis == 0 ? tr("Radial / ulnar deviation") : axis == 1 ? pronation : usual[axis];
    case kAnkle:
        return axis == 0   ? tr("Eversion / inversion")
               : axis == 2 ? tr("Dorsiflexion / plantar flexion")
                           : usual[axis];
    case kBallOfFoot:
        return axis == 2 ? tr("Extension / flexion") : usual[axis];
    default:
        return usual[axis];
    }
}

/// The facts about a character's joints at the cursor.
struct Reading {
    BodyAngles sent;     ///< of the sample of the pose, else the newest
    BodyAngles computed; ///< of the pose
    bool isSent = false;
    const model::CharacterPose* pose = nullptr;
    bool isSameSample = false;
    log::Stamp stamp{};
};

Reading readJoints(const model::SessionView& view, const model::CharacterKey& key) {
    Reading reading;
    reading.sent = reading.computed = model::anglesOf(wire::JointAngles());
    reading.pose = view.messages().pose(key);
    reading.pose = reading.pose != nullptr && reading.pose->isObjects ? nullptr : reading.pose;
    if (reading.pose != nullptr) {
        reading.stamp = reading.pose->stamp;
        const auto& body = view.messages().bodyOrigins(key);
        reading.computed = model::anglesOf(*reading.pose, model::stanceOf(body.places));
    }
    const auto take = [&reading](const model::Message& message) {
        if (const auto* body = std::get_if<wire::JointAngles>(&message.datagram.body)) {
            reading.sent = model::anglesOf(*body);
            reading.isSent = true;
            reading.isSameSample =
                reading.pose != nullptr && message.datagram.header.sampleCounter == reading.pose->sample;
        }
    };
    if (const auto* newest = view.messages().message(key, wire::JointAngles::kType)) {
        take(*newest);
        reading.stamp = std::max(reading.stamp, newest->stamp);
    }
    if (reading.isSent && reading.pose != nullptr && !reading.isSameSample) {
        constexpr std::size_t kMostSamples = 64;
        const log::StreamKey stream{key.sender, key.character, wire::JointAngles::kType};
        view.messages().visit(stream, reading.pose->stamp - model::kSentTogether, kMostSamples,
                              [&](const model::Message& message) {
                                  if (message.datagram.header.sampleCounter == reading.pose->sample) {
                                      take(message);
                                  }
                              });
    }
    return reading;
}

QString sourceOf(const Reading& reading) {
    QStringList types;
    for (const std::uint8_t type :
         reading.pose != nullptr ? reading.pose->types : decltype(reading.pose->types)()) {
        types += QStringLiteral("%1").arg(type, 2, 10, QLatin1Char('0'));
    }
    const QString computed = types.isEmpty() ? QString() : tr("computed from %1").arg(types.join(u' '));
    return !reading.isSent ? computed : computed.isEmpty() ? tr("sent") : tr("sent · %1").arg(computed);
}

/// Sent and computed apart, the computed angles in the form that is closest to those sent.
JointRow rowOf(std::size_t joint, const Reading& reading) {
    JointRow row{joint, reading.sent[joint], reading.computed[joint],
                 std::numeric_limits<double>::quiet_NaN()};
    const model::JointDefinition& definition = model::jointDefinitions()[joint];
    if (row.sent.allFinite() && row.computed.allFinite()) {
        row.computed = model::closestAngles(definition, row.computed, row.sent);
        if (reading.isSameSample) {
            row.difference = model::jointDifference(definition, row.sent, row.computed);
        }
    }
    return row;
}

/// The place of an angle between the ends of its reference range, for the bar of its cell.
QVariant barOf(const JointRow& row, std::size_t axis, const model::JointExtents& extents) {
    const auto reference = model::referenceRange(row.joint, axis);
    if (!reference || !row.shown().allFinite()) {
        return {};
    }
    const model::AngleRange& taken = extents.range(row.joint, axis);
    const double now = component(model::anatomicalAngles(row.joint, row.shown()), axis);
    QList<float> bar;
    for (const double end : {reference->least, reference->most, taken.isEmpty() ? now : taken.least,
                             taken.isEmpty() ? now : taken.most, now}) {
        bar += static_cast<float>(end);
    }
    return QVariant::fromValue(bar);
}

TableColumn<JointRow> angleColumn(const JointModel& joints, const QString& title, std::size_t axis) {
    const auto isBoth = [](const JointRow& row) { return row.sent.allFinite() && row.computed.allFinite(); };
    return TableColumn<JointRow>::numbers(
               title,
               tr("As sent in type 20, and smaller as computed from the pose. The bar is the reference "
                  "range; the coloured part of it is how far the joint went, the line is the angle."),
               [axis](const JointRow& row) { return degrees(component(row.shown(), axis)); })
        .in({.usual = QStringLiteral("−180.0"), .wish = QStringLiteral("−180.0 −180.0")})
        .withToolTip([axis](const JointRow& row) {
            const auto at = static_cast<int>(std::ranges::find(kJointOrder, row.joint) - kJointOrder.begin());
            return tr("%1: sent %2, computed %3")
                .arg(motionName(at, axis), degrees(component(row.sent, axis)),
                     degrees(component(row.computed, axis)));
        })
        .withMore([&joints, axis, isBoth](const JointRow& row, int role) -> QVariant {
            return role == kSuffixRole && isBoth(row) ? QVariant(degrees(component(row.computed, axis)))
                   : role == kBarRole                 ? barOf(row, axis, joints.motion().extents())
                                                      : QVariant();
        });
}

template <class Row, class IsStale>
std::vector<TableColumn<Row>> dimmedWhile(std::vector<TableColumn<Row>> columns, IsStale isStale) {
    for (TableColumn<Row>& column : columns) {
        column.colour = [isStale, own = column.colour](const Row& row) {
            return isStale(row) ? QVariant(theme().dim) : own ? own(row) : QVariant();
        };
    }
    return columns;
}

std::vector<TableColumn<AngleRow>> angleColumns() {
    using Angle = TableColumn<AngleRow>;
    const auto rowOf = [](const AngleRow& angle) -> const JointRow& {
        return angle.joints->rows()[static_cast<std::size_t>(angle.joints->shownRow())];
    };
    const auto number = [](const QString& title, const QString& help, const QString& usual, int order,
                           Angle::Words read) {
        return Angle::numbers(title, help, std::move(read)).in({.usual = usual, .order = order});
    };
    const auto takenOf = [](const AngleRow& angle, const JointRow& row) {
        return rangeText(angle.joints->motion().extents().range(row.joint, angle.axis), 1);
    };
    const auto mirrored = [](const AngleRow& angle) -> const JointRow* {
        const auto row = angle.joints->mirroredRow(angle.joints->shownRow());
        return row ? &angle.joints->rows()[static_cast<std::size_t>(*row)] : nullptr;
    };
    const QString range = QStringLiteral("−180.0 to 180.0");
    const QString angle = QStringLiteral("−180.0");
    auto taken = valueColumn(
        Angle{.title = tr("Went °"),
              .help = tr("From the least to the most over the range that all figures are of."),
              .isNumber = true,
              .room = {.usual = QStringLiteral("▲ ") + range}},
        [=](const AngleRow& row) {
            const bool isBeyond = row.joints->motion().extents().isBeyond(rowOf(row).joint, row.axis);
            return PropertyValue{takenOf(row, rowOf(row)), isBeyond ? Health::Warning : Health::Unknown};
        });
    return withHelpInCells(std::vector<Angle>{
        Angle::words(tr("Angle"), tr("The first is the motion of positive angles."),
                     [](const AngleRow& row) { return motionName(row.joints->shownRow(), row.axis); })
            .in({.usual = tr("Internal / external rotation"), .isOpen = true}),
        number(tr("Sent °"), tr("In type 20."), angle, 4,
               [=](const AngleRow& row) { return degrees(component(rowOf(row).sent, row.axis)); }),
        number(tr("Computed °"), tr("From the pose."), angle, 3,
               [=](const AngleRow& row) { return degrees(component(rowOf(row).computed, row.axis)); }),
        std::move(taken),
        number(tr("Reference °"), tr("Average of healthy joints: %1.").arg(fromUtf8(model::kRangeSource)),
               QStringLiteral("−180 to 180"), 5,
               [=](const AngleRow& row) {
                   return rangeText(model::referenceRange(rowOf(row).joint, row.axis), 0);
               }),
        number(tr("Other side °"), tr("The same angle of the other side."), angle, 2,
               [=](const AngleRow& row) {
                   const JointRow* other = mirrored(row);
                   return other != nullptr ? degrees(component(other->shown(), row.axis)) : dash();
               }),
        number(tr("Other side went °"), tr("How far the other side went."), range, 1,
               [=](const AngleRow& row) {
                   const JointRow* other = mirrored(row);
                   return other != nullptr ? takenOf(row, *other) : dash();
               }),
    });
}

} // namespace

JointModel::JointModel(model::SessionView& view) : TableModel(columns(*this)), m_view(view) {}

std::vector<TableColumn<JointRow>> JointModel::columns(const JointModel& joints) {
    using Joint = TableColumn<JointRow>;
    std::vector<Joint> columns{
        Joint::words(
            tr("Joint"), {},
            [](const JointRow& row) { return fromUtf8(model::jointDefinitions()[row.joint].displayName); })
            .in({QStringLiteral("Right Ball of Foot")}),
        angleColumn(joints, tr("Flexion °"), 2),
        angleColumn(joints, tr("Abduction °"), 0),
        angleColumn(joints, tr("Rotation °"), 1),
        valueColumn(
            Joint{.title = tr("Diff. °"),
                  .help = tr("The one turn between what was sent and what is computed from the pose "
                             "of the same sample. Marked above %1°.")
                              .arg(kMarkedDifference),
                  .isNumber = true,
                  .room = {.usual = QStringLiteral("▲ 180.0"), .order = 2}},
            [](const JointRow& row) {
                const bool isMarked = row.difference * kDegreesPerRadian > kMarkedDifference;
                return PropertyValue{degrees(row.difference), isMarked ? Health::Warning : Health::Unknown};
            }),
        valueColumn(
            Joint{.title = tr("Flags"),
                  .help = tr("Gimbal lock: the abduction is within 5° of 90°, so flexion and rotation "
                             "mean little by themselves. Beyond: over the range of the figures, an "
                             "angle was outside its reference range."),
                  .room = {.usual = QStringLiteral("▲ beyond"), .order = 1, .isOpen = true}},
            [&joints](const JointRow& row) { return joints.state(row); }),
    };
    return dimmedWhile(withHelpInCells(std::move(columns)),
                       [&joints](const JointRow&) { return joints.isStale(); });
}

void JointModel::refresh() {
    m_key = shownCharacter(m_view);
    const Reading reading = m_key ? readJoints(m_view, *m_key) : Reading{};
    std::vector<JointRow> rows;
    m_source.clear();
    m_stale.clear();
    if (reading.isSent || reading.pose != nullptr) {
        std::ranges::transform(kJointOrder, std::back_inserter(rows),
                               [&](std::size_t joint) { return rowOf(joint, reading); });
        const std::uint8_t type = reading.pose != nullptr ? reading.pose->type : wire::JointAngles::kType;
        const model::Stream* stream =
            m_view.roster().find(log::StreamKey{m_key->sender, m_key->character, type});
        m_stale = gui::staleText(log::secondsOf(m_view.cursorStamp() - reading.stamp),
                                 stream == nullptr ? 0 : stream->statistics.rateHz());
        m_source = sourceOf(reading);
        m_motion.follow(m_view, *m_key, reading.pose == nullptr);
    }
    showSegment(m_view.choices().selection.segment);
    setRows(std::move(rows));
}

void JointModel::showSegment(int segment) {
    for (int row = 0; row < kBodyJointCount && segment != m_segment; ++row) {
        m_shownRow = segmentOf(row) == segment ? row : m_shownRow;
    }
    m_segment = segment;
}

int JointModel::segmentOf(int row) const {
    return model::jointDefinitions()[kJointOrder[static_cast<std::size_t>(row)]].childSegment();
}

std::optional<int> JointModel::mirroredRow(int row) const {
    return row < static_cast<int>(kSpineJoints) ? std::nullopt : std::optional(row ^ 1);
}

PropertyValue JointModel::state(const JointRow& row) const {
    if (isStale()) {
        return {m_stale};
    }
    const bool isBeyond = m_motion.extents().isBeyond(row.joint, 0) ||
                          m_motion.extents().isBeyond(row.joint, 1) ||
                          m_motion.extents().isBeyond(row.joint, 2);
    if (row.shown().allFinite() && model::isNearGimbalLock(row.shown())) {
        return {isBeyond ? tr("gimbal lock, beyond") : tr("gimbal lock"), Health::Warning};
    }
    return isBeyond ? PropertyValue{tr("beyond"), Health::Warning} : PropertyValue{};
}

AngleModel::AngleModel(const JointModel& joints)
    : TableModel(dimmedWhile(angleColumns(), [](const AngleRow& row) { return row.joints->isStale(); })),
      m_joints(joints) {}

void AngleModel::refresh() {
    std::vector<AngleRow> rows;
    for (const std::size_t axis : {2U, 0U, 1U}) {
        rows.push_back({&m_joints, axis});
    }
    setRows(m_joints.rowCount() == 0 ? std::vector<AngleRow>() : rows);
}

} // namespace posewire::gui
