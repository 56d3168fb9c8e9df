// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/models/curve_text.h"

#include "app/gui/models/field_text.h"
#include "app/gui/models/text.h"
#include "core/feed/signal.h"

#include <QMimeData>

#include <cmath>

namespace posewire::gui {

namespace {

constexpr const char* kMimeType = "application/x-posewire-curves";

/// Puts the type before a name, if that is understood and needed; empty if there is no such signal.
QString understood(std::uint8_t type, const QString& name, const QString& of) {
    const QString text = of.isEmpty() ? name : QStringLiteral("%1 of \"%2\"").arg(name, of);
    const QString exact = QStringLiteral("%1.%2").arg(type, 2, 10, QLatin1Char('0')).arg(text);
    const auto signal = feed::parseSignal(text.toStdString());
    return signal && signal->types.size() <= 1                  ? text
           : feed::parseSignal(exact.toStdString()).has_value() ? exact
           : signal                                             ? text
                                                                : QString();
}

} // namespace

QStringList curvesOf(const FieldDocument& document, std::int32_t node) {
    const wire::FieldNode& field = document.node(node);
    const std::int32_t item = document.itemOf(node);
    const QString of =
        item >= 0 ? identifierText(document, item).section(QStringLiteral(" · "), -1) : QString();
    QString name = QString::fromStdString(field.name);
    QStringList components;
    if (field.kind == wire::NodeKind::Part && field.parent >= 0) {
        components += QString::fromStdString(field.name);
        name = QString::fromStdString(document.node(field.parent).name);
    } else if (field.components > 1) {
        for (const std::string_view component : wire::componentNames(field.components)) {
            components += QString::fromLatin1(component.data(), static_cast<qsizetype>(component.size()));
        }
    } else if (field.kind != wire::NodeKind::Field || std::isnan(field.number)) {
        return {};
    }
    QStringList curves;
    for (const QString& component : components.isEmpty() ? QStringList(QString()) : components) {
        const QString whole = component.isEmpty() ? name : name + QLatin1Char('.') + component;
        if (const QString text = understood(document.type(), whole, of); !text.isEmpty()) {
            curves += text;
        }
    }
    return curves;
}

QStringList curvesOfTracker(const char* field, std::uint32_t id) {
    const auto names = field::namesOf(field::Kind::Segment);
    const QString of = id >= 1 && id <= names.size() ? QString::fromStdString(std::string(names[id - 1]))
                                                     : QString::number(id);
    QStringList curves;
    for (const char* component : {"x", "y", "z"}) {
        curves += understood(wire::TrackerKinematics::kType,
                             QLatin1String(field) + QLatin1Char('.') + QLatin1String(component), of);
    }
    curves.removeAll(QString());
    return curves;
}

QMimeData* asDragged(const QStringList& curves) {
    auto* data = new QMimeData;
    data->setData(QLatin1String(kMimeType), curves.join(QLatin1Char('\n')).toUtf8());
    data->setText(curves.join(QLatin1Char('\n')));
    return data;
}

QStringList draggedCurves(const QMimeData& data) {
    const QByteArray curves = data.data(QLatin1String(kMimeType));
    return QString::fromUtf8(curves).split(QLatin1Char('\n'), Qt::SkipEmptyParts);
}

} // namespace posewire::gui
