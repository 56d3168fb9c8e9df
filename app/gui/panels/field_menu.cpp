// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/panels/field_menu.h"

#include "app/gui/models/field_text.h"
#include "core/filter/completion.h"

#include <QCoreApplication>
#include <QMenu>

namespace posewire::gui {

namespace {

QString tr(const char* text) {
    return QCoreApplication::translate("FieldMenu", text);
}

QString bytesText(const FieldDocument& document, std::int32_t node, const QString& prefix,
                  const QString& separator) {
    const wire::FieldNode& field = document.node(node);
    QStringList bytes;
    for (std::uint32_t i = field.offset; i < field.offset + field.length; ++i) {
        const auto value = std::to_integer<unsigned>(document.bytes()[i]);
        bytes += prefix + QString::number(value, 16).rightJustified(2, QLatin1Char('0'));
    }
    return bytes.join(separator);
}

void addFilters(QMenu& menu, const FieldMenu& field) {
    const QString expression =
        QString::fromStdString(filter::expressionFor(field.document.tree(), field.node));
    const QString current = QString::fromStdString(field.displayFilter);
    QMenu* filters = menu.addMenu(tr("Apply as filter"));
    filters->setEnabled(!expression.isEmpty());
    const auto add = [&](const QString& text, FilterUse use) {
        const QString joined = joinedFilter(current, expression, use);
        Commands* commands = &field.commands;
        QAction* action =
            filters->addAction(text, filters, [commands, joined] { commands->setDisplayFilter(joined); });
        action->setToolTip(joined);
    };
    filters->setToolTipsVisible(true);
    add(expression, FilterUse::Replace);
    add(tr("Not this"), FilterUse::Not);
    add(tr("… and this"), FilterUse::And);
    add(tr("… or this"), FilterUse::Or);
    add(tr("… and not this"), FilterUse::AndNot);
}

} // namespace

QString joinedFilter(const QString& filter, const QString& expression, FilterUse use) {
    const QString negated = QStringLiteral("!(%1)").arg(expression);
    const bool isEmpty = filter.trimmed().isEmpty();
    switch (use) {
    case FilterUse::Replace:
        return expression;
    case FilterUse::Not:
        return negated;
    case FilterUse::And:
        return isEmpty ? expression : QStringLiteral("(%1) && %2").arg(filter, expression);
    case FilterUse::Or:
        return isEmpty ? expression : QStringLiteral("(%1) || %2").arg(filter, expression);
    case FilterUse::AndNot:
        return isEmpty ? negated : QStringLiteral("(%1) && %2").arg(filter, negated);
    }
    return expression;
}

QString hexText(const FieldDocument& document, std::int32_t node) {
    return bytesText(document, node, QString(), QStringLiteral(" "));
}

QString arrayText(const FieldDocument& document, std::int32_t node) {
    return QLatin1Char('{') + bytesText(document, node, QStringLiteral("0x"), QStringLiteral(", ")) +
           QLatin1Char('}');
}

void showFieldMenu(const FieldMenu& field, QWidget* parent, const QPoint& at) {
    QMenu menu(parent);
    addFilters(menu, field);
    menu.addSeparator();
    const auto addCopy = [&](const QString& text, const QString& copied) {
        Commands* commands = &field.commands;
        menu.addAction(text, &menu, [commands, copied] { commands->copyText(copied); })
            ->setEnabled(!copied.isEmpty());
    };
    addCopy(tr("Copy value"), convertedValue(field.document, field.node));
    addCopy(tr("Copy value on the wire"), QString::fromStdString(field.document.node(field.node).value));
    addCopy(tr("Copy field path"), QString::fromStdString(field.document.tree().path(field.node)));
    addCopy(tr("Copy bytes as hexadecimal"), hexText(field.document, field.node));
    addCopy(tr("Copy bytes as C array"), arrayText(field.document, field.node));
    menu.exec(at);
}

} // namespace posewire::gui
