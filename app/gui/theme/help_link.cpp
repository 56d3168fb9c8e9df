// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/theme/help_link.h"

#include "app/gui/theme/widgets.h"
#include "app/gui/theme/words.h"

#include <QDesktopServices>
#include <QDialog>
#include <QDialogButtonBox>
#include <QMessageBox>
#include <QPushButton>
#include <QShortcut>
#include <QUrl>

namespace posewire::gui {

namespace {

constexpr const char* kPlace = "helpPlace";

} // namespace

void openHelp(const QString& place) {
    QUrl url;
    url.setScheme(QLatin1String(kHelpScheme));
    url.setPath(place.section(u'#', 0, 0));
    url.setFragment(place.section(u'#', 1));
    QDesktopServices::openUrl(url);
}

void setHelpPlace(QWidget& widget, const QString& place) {
    widget.setProperty(kPlace, place);
}

QString helpPlaceOf(const QWidget* widget) {
    for (; widget != nullptr; widget = widget->parentWidget()) {
        if (const QString place = widget->property(kPlace).toString(); !place.isEmpty()) {
            return place;
        }
    }
    return {};
}

QToolButton* helpButton(const QString& about, const QString& place, QWidget* parent) {
    QToolButton* button = flatButton(QStringLiteral("?"), tr("Help on %1").arg(about), parent);
    button->setObjectName(QStringLiteral("helpButton"));
    button->setFocusPolicy(Qt::TabFocus);
    QObject::connect(button, &QToolButton::clicked, button, [place] { openHelp(place); });
    return button;
}

void offerHelp(QMessageBox& message, const QString& place) {
    QAbstractButton* help = message.addButton(QMessageBox::Help);
    QObject::disconnect(help, &QAbstractButton::clicked, nullptr, nullptr); // else it would end the message
    const auto open = [place] { openHelp(place); };
    QObject::connect(help, &QAbstractButton::clicked, &message, open);
    QObject::connect(new QShortcut(QKeySequence::HelpContents, &message), &QShortcut::activated, &message,
                     open);
}

void offerHelp(QDialog& dialog, QDialogButtonBox& buttons, const QString& place) {
    setHelpPlace(dialog, place);
    const auto open = [place] { openHelp(place); };
    QObject::connect(buttons.addButton(QDialogButtonBox::Help), &QPushButton::clicked, &dialog, open);
    QObject::connect(new QShortcut(QKeySequence::HelpContents, &dialog), &QShortcut::activated, &dialog,
                     open);
}

void layOut(QDialog& dialog, std::initializer_list<std::variant<QWidget*, QLayout*>> parts,
            QDialogButtonBox& buttons, const QString& helpPlace, int characters) {
    auto* column = new QVBoxLayout(&dialog);
    column->setSpacing(dialog.fontMetrics().height());
    for (const auto& part : parts) {
        if (QWidget* const* widget = std::get_if<QWidget*>(&part)) {
            column->addWidget(*widget);
        } else {
            column->addLayout(std::get<QLayout*>(part));
        }
    }
    column->addWidget(&buttons);
    QObject::connect(&buttons, &QDialogButtonBox::accepted, &dialog, &QDialog::accept);
    QObject::connect(&buttons, &QDialogButtonBox::rejected, &dialog, &QDialog::reject);
    offerHelp(dialog, buttons, helpPlace);
    dialog.setMinimumWidth(dialog.fontMetrics().averageCharWidth() * characters);
}

} // namespace posewire::gui
