// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/models/null_pose_facts.h"

#include "app/gui/models/text.h"
#include "app/gui/theme/words.h"

namespace posewire::gui {

namespace {

PropertyValue none() {
    return {QStringLiteral("–")};
}

QString age(const NullPoseReading& reading, log::Stamp stamp) {
    const double seconds = log::secondsOf(reading.view().cursorStamp() - stamp);
    return duration(std::max(seconds, 0.0));
}

/// "10:42:17": scale messages come seconds apart.
QString secondsOfDay(log::Stamp stamp) {
    return timeOfDay(stamp).section(QLatin1Char('.'), 0, 0);
}

PropertyValue parts(const NullPoseReading& reading) {
    if (!reading.newest()) {
        return none();
    }
    const model::NullPoseMessage& message = *reading.newest();
    const QString whole =
        message.partsExpected == 0 ? QStringLiteral("?") : QString::number(message.partsExpected);
    const double silence = log::secondsOf(reading.view().cursorStamp() - message.stamp);
    const Health health = message.isComplete()             ? Health::Good
                          : silence >= model::kPartOverdue ? Health::Error
                                                           : Health::Unknown;
    QString text = tr("%1 of %2").arg(message.partsReceived).arg(whole);
    QStringList missing;
    for (const unsigned part : message.missingParts) {
        missing += QString::number(part + 1);
    }
    if (!missing.isEmpty()) {
        text += tr(", no %1").arg(missing.join(QStringLiteral(", ")));
    }
    return {text, health, tr("Datagrams of the newest type 13 message")};
}

PropertyValue received(const NullPoseReading& reading) {
    if (!reading.newest()) {
        return none();
    }
    const log::Stamp stamp = reading.newest()->stamp;
    return {secondsOfDay(stamp) + QStringLiteral(" · ") + age(reading, stamp), Health::Unknown,
            tr("When its newest part came, and how long ago")};
}

PropertyValue messages(const NullPoseReading& reading) {
    QString text = grouped(reading.messages());
    if (reading.repetition() > log::Duration::zero()) {
        text += tr(" · every %1").arg(duration(log::secondsOf(reading.repetition())));
    }
    return {text, Health::Unknown, tr("Type 13 messages so far, and the median time between them")};
}

PropertyValue changed(const NullPoseReading& reading) {
    if (reading.pose() == nullptr) {
        return none();
    }
    if (!reading.hasChanged()) {
        return {tr("never"), Health::Unknown, tr("All messages said the same")};
    }
    return {secondsOfDay(reading.changed()) + QStringLiteral(" · ") + age(reading, reading.changed()),
            Health::Warning, tr("When a message said something else than the one before, and how long ago")};
}

PropertyValue metres(const std::optional<double>& value, bool isEstimated) {
    if (!value) {
        return none();
    }
    return {(isEstimated ? QStringLiteral("≈ ") : QString()) + fixed(*value, 3) + QStringLiteral(" m"),
            Health::Unknown,
            isEstimated
                ? tr("Estimated: without points, head, hands and soles are those of the reference body")
                : tr("From the points that were sent")};
}

PropertyValue countOf(std::size_t count, const NullPoseReading& reading) {
    return reading.pose() == nullptr ? none() : PropertyValue{grouped(count)};
}

PropertyValue scale(const NullPoseReading& reading) {
    return reading.scale() == nullptr ? PropertyValue{tr("not sent")}
                                      : PropertyValue{tr("%1 segments · %2")
                                                          .arg(reading.scale()->segments.size())
                                                          .arg(age(reading, reading.scaleStamp()))};
}

PropertyValue props(const NullPoseReading& reading) {
    if (reading.props() == nullptr) {
        return {tr("not sent")};
    }
    QStringList names;
    for (const wire::Prop& prop : reading.props()->props) {
        names += QStringLiteral("%1 %2").arg(prop.id).arg(QString::fromStdString(prop.name));
    }
    return names.isEmpty() ? PropertyValue{tr("none")} : PropertyValue{names.join(QStringLiteral(", "))};
}

} // namespace

std::vector<Property> nullPoseFacts(const NullPoseReading& reading) {
    const NullPoseReading* from = &reading;
    return {
        {tr("Parts"), [from] { return parts(*from); }},
        {tr("Received"), [from] { return received(*from); }},
        {tr("Messages"), [from] { return messages(*from); }},
        {tr("Changed"), [from] { return changed(*from); }},
        {tr("Segments"),
         [from] { return countOf(from->pose() == nullptr ? 0 : from->pose()->segments.size(), *from); }},
        {tr("Points"),
         [from] { return countOf(from->pose() == nullptr ? 0 : from->pose()->points.size(), *from); }},
        {tr("Height"), [from] { return metres(from->measures().height, from->measures().isEstimated); }},
        {tr("Arm span"), [from] { return metres(from->measures().armSpan, from->measures().isEstimated); }},
        {tr("Type 10"), [from] { return scale(*from); }},
        {tr("Props (11)"), [from] { return props(*from); }},
    };
}

Health healthOf(model::Severity severity) {
    return severity == model::Severity::Error     ? Health::Error
           : severity == model::Severity::Warning ? Health::Warning
                                                  : Health::Unknown;
}

QString findingsText(const std::vector<model::NullPoseFinding>& findings) {
    QString text;
    for (const model::NullPoseFinding& finding : findings) {
        const Health health = healthOf(finding.severity);
        text += (health == Health::Unknown ? QStringLiteral("○") : healthSymbol(health)) + QLatin1Char(' ') +
                QString::fromStdString(finding.what) + QLatin1Char(' ') +
                QString::fromStdString(finding.meaning) + QLatin1Char('\n');
    }
    return text;
}

} // namespace posewire::gui
