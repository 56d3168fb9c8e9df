// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/window/preferences.h"

#include "app/gui/theme/help_link.h"
#include "app/gui/theme/widgets.h"
#include "app/gui/theme/words.h"
#include "app/gui/viewport/overlays.h"
#include "app/gui/window/command_palette.h"
#include "app/gui/window/main_window.h"
#include "app/gui/window/recording_dialogs.h"

#include <QAction>
#include <QDialogButtonBox>
#include <QFormLayout>
#include <QKeyEvent>
#include <QMenuBar>
#include <QScrollArea>
#include <QScrollBar>

#include <algorithm>

namespace posewire::gui {

namespace {

/// The words by which a part of a row is found: its own and those of all widgets in it.
QString wordsOf(QWidget* widget) {
    QStringList words;
    for (const QWidget* part : QWidgetList{widget} + widget->findChildren<QWidget*>()) {
        words << synonymsOf(part->objectName());
        for (const char* property : {"text", "toolTip", "accessibleName", "accessibleDescription"}) {
            words << part->property(property).toString();
        }
    }
    return words.join(u' ').remove(u'&');
}

/// A check box for an entry of the menus, or a list of entries of which one is checked at a time.
QWidget* fieldFor(const std::vector<Command>& commands) {
    if (commands.size() == 1) {
        auto* box = new QCheckBox(commands[0].name);
        box->setChecked(commands[0].action->isChecked());
        QObject::connect(box, &QCheckBox::clicked, commands[0].action, &QAction::trigger);
        QObject::connect(commands[0].action, &QAction::toggled, box, &QCheckBox::setChecked);
        return box;
    }
    auto* list = new ComboBox;
    for (const Command& command : commands) {
        const auto show = [list, index = list->count()](bool isOn) {
            list->setCurrentIndex(isOn ? index : list->currentIndex());
        };
        list->addItem(command.name, QVariant::fromValue(command.action));
        list->setAccessibleDescription(list->accessibleDescription() + u' ' + command.name);
        show(command.action->isChecked());
        QObject::connect(command.action, &QAction::toggled, list, show);
    }
    QObject::connect(list, &QComboBox::activated, list,
                     [list] { list->currentData().value<QAction*>()->trigger(); });
    return list;
}

class PreferencesDialog final : public QDialog {
public:
    PreferencesDialog(MainWindow& window, PreferencesSection section)
        : QDialog(&window), m_all(commandsOf(*window.menuBar())) {
        setWindowTitle(tr("Preferences"));
        m_search->setPlaceholderText(tr("Search preferences"));
        m_search->setAccessibleName(m_search->placeholderText());
        m_search->setClearButtonEnabled(true);
        connect(m_search, &QLineEdit::textChanged, this, &PreferencesDialog::filter);
        m_rows->setContentsMargins(0, 0, fontMetrics().height(), 0);
        m_rows->addRow(m_elsewhere);
        m_elsewhere->setTextInteractionFlags(Qt::LinksAccessibleByMouse | Qt::LinksAccessibleByKeyboard);
        connect(m_elsewhere, &QLabel::linkActivated, this, [this, &window](const QString& place) {
            accept();
            carryOut(window, *m_all.at(place.toUInt()).action);
        });
        addSections(window);
        for (QWidget* part : m_page->findChildren<QWidget*>()) {
            part->installEventFilter(this);
            if (part->focusPolicy() == Qt::WheelFocus) {
                part->setFocusPolicy(Qt::StrongFocus);
            }
        }
        m_area->setWidget(m_page);
        m_area->setWidgetResizable(true);
        m_area->setFocusPolicy(Qt::NoFocus);
        m_area->setMinimumWidth(m_page->minimumSizeHint().width() +
                                m_area->verticalScrollBar()->sizeHint().width());
        layOut(*this, {m_search, m_area}, *new QDialogButtonBox(QDialogButtonBox::Close, this),
               placeOf(HelpTopic::Preferences), 92);
        filter({});
        resize(minimumWidth(), window.height() - 4 * fontMetrics().height());
        if (section != PreferencesSection::Appearance) {
            QTimer::singleShot(0, this, [this, heading = m_headings.at(static_cast<int>(section))] {
                m_area->verticalScrollBar()->setValue(heading->y()); // once it has its size
                heading->findChild<QToolButton*>()->setFocus();
                focusNextChild();
            });
        }
    }

protected:
    /// Escape leaves the search before it leaves the dialog; Enter in a field presses no button.
    void keyPressEvent(QKeyEvent* event) override {
        if (event->key() == Qt::Key_Escape && !m_search->text().isEmpty()) {
            m_search->clear();
            m_search->setFocus();
        } else if (event->key() != Qt::Key_Return && event->key() != Qt::Key_Enter) {
            QDialog::keyPressEvent(event);
        }
    }

    /// The wheel scrolls past fields without changing them.
    bool eventFilter(QObject* /*field*/, QEvent* event) override {
        event->setAccepted(event->isAccepted() && event->type() != QEvent::Wheel);
        return event->type() == QEvent::Wheel;
    }

private:
    void addSections(MainWindow& window) {
        begin(tr("Appearance"), HelpTopic::Preferences);
        addEntries(QStringLiteral("themeSystem|themeDark|themeLight"));
        begin(tr("Viewport"), HelpTopic::Viewport);
        addEntries(QStringLiteral("axesOfAll|axesOfSelected|axesOfNone interpolation orthographic "
                                  "relativeViews splitOne|splitTwo|splitFour scale segmentCard"));
        for (const OverlayEntry& overlay : kOverlayTable) {
            addEntries(QLatin1String(overlay.key));
        }
        begin(tr("Lists"), HelpTopic::Preferences);
        addEntries(QStringLiteral("timeSinceFirst|timeOfDay deltaInStream|deltaToRowAbove troubleFirst "
                                  "characterDetail currentIncidents|incidentHistory listErrors "
                                  "listWarnings listNotes listSenderIncidents listLossIncidents "
                                  "listContentIncidents listLimitIncidents"));
        Settings& kept = window.kept();
        SessionDriver& driver = window.driver();
        begin(tr("Recording"), HelpTopic::RecordingOptions, "recordingOptions");
        addRecordingRows(*m_rows, kept.recording);
        begin(tr("History"), HelpTopic::History, "history");
        addHistoryRows(*m_rows, kept.history, driver.history(), driver.commands().live());
        begin(tr("Thresholds and alerts"), HelpTopic::Thresholds, "thresholds");
        addThresholdRows(*m_rows, kept.alerts,
                         [&] { driver.commands().setThresholds(kept.alerts.thresholds); });
    }

    /// Begins a section, which is also found by the synonyms of an entry of the menus.
    void begin(const QString& title, HelpTopic topic, const char* entry = "") {
        auto* heading = new QWidget(m_page);
        heading->setObjectName(QLatin1String(entry));
        auto* label = plainLabel(title, heading);
        label->setProperty("heading", true);
        auto* row = spacedRow({}, -1);
        row->addWidget(label, 1);
        row->addWidget(helpButton(title, placeOf(topic), heading));
        auto* column = tightColumn(heading);
        column->setContentsMargins(0, m_headings.empty() ? 0 : fontMetrics().height(), 0, 4);
        column->addLayout(row);
        column->addWidget(new Line(heading));
        m_rows->addRow(heading);
        m_headings << heading;
    }

    /// Adds a check box for each entry of the menus, and a list for entries that are joined by |.
    void addEntries(const QString& ids) {
        for (const QString& row : ids.split(u' ')) {
            std::vector<Command> commands;
            std::ranges::copy_if(m_all, std::back_inserter(commands), [&](const Command& one) {
                return row.split(u'|').contains(one.action->objectName());
            });
            const Command& first = commands.front();
            QWidget* field = fieldFor(commands);
            auto* group = plainLabel(m_page);
            group->setAccessibleName(first.menu.section(QStringLiteral(" › "), -1));
            field->setObjectName(first.action->objectName());
            field->setToolTip(toolTipText(first.menu));
            field->setAccessibleName(commands.size() == 1 ? first.name : group->accessibleName());
            m_rows->addRow(group, field);
        }
    }

    /// Shows the rows that match and the headings of their sections; the first of a group has its name.
    void filter(const QString& typed) {
        int heading = 0;
        QString group;
        m_rows->setRowVisible(0, true);
        for (int row = 1; row < m_rows->rowCount(); ++row) {
            QWidget* field = fieldAt(row);
            QWidget* label = m_rows->labelForField(field);
            heading = m_headings.contains(field) ? row : heading;
            const QString own = wordsOf(field) + (label != nullptr ? u' ' + wordsOf(label) : QString());
            const bool isShown = heading != row && isMeant({nullptr, own, wordsOf(fieldAt(heading))}, typed);
            m_rows->setRowVisible(row, isShown);
            if (isShown) {
                m_rows->setRowVisible(0, false);
                m_rows->setRowVisible(heading, true);
            }
            if (isShown && label != nullptr) {
                m_labelWidth = std::max(m_labelWidth, label->sizeHint().width());
                label->setMinimumWidth(m_labelWidth); // fields stay in their place
                const QString name = label->accessibleName();
                if (!name.isEmpty()) {
                    label->setProperty("text", name == group ? QString() : name);
                    group = name;
                }
            }
        }
        if (m_rows->isRowVisible(0)) {
            m_elsewhere->setText(elsewhere(typed));
        }
        m_area->verticalScrollBar()->setValue(0);
    }

    /// Lists the entries of the menus that match, as links.
    [[nodiscard]] QString elsewhere(const QString& typed) const {
        constexpr int kMost = 8;
        QStringList lines{tr("Nothing found")};
        for (std::size_t i = 0; i < m_all.size(); ++i) {
            const Command& one = m_all[i];
            if (isMeant(one, typed)) {
                const QString text = one.menu + QStringLiteral(" › ") + one.name;
                lines[0] = tr("No preference, but in the menus:");
                lines << QStringLiteral("<a href=\"%1\">%2</a> %3")
                             .arg(i)
                             .arg(text.toHtmlEscaped(), one.keys.toHtmlEscaped());
            }
        }
        return lines.mid(0, kMost).join(QStringLiteral("<br>"));
    }

    [[nodiscard]] QWidget* fieldAt(int row) const {
        return m_rows->itemAt(row, QFormLayout::FieldRole)->widget();
    }

    std::vector<Command> m_all;
    QWidgetList m_headings;
    int m_labelWidth = 0;
    QLineEdit* m_search = new QLineEdit(this);
    QScrollArea* m_area = new QScrollArea(this);
    QWidget* m_page = new QWidget(this);
    QLabel* m_elsewhere = richLabel(m_page); ///< what is in the menus instead
    QFormLayout* m_rows = new QFormLayout(m_page);
};

} // namespace

void openPreferences(MainWindow& window, PreferencesSection section) {
    auto* dialog = new PreferencesDialog(window, section);
    dialog->setAttribute(Qt::WA_DeleteOnClose);
    QObject::connect(dialog, &QDialog::finished, &window, [&window, before = window.kept().history] {
        if (window.kept().history != before) {
            window.keepHistory();
        }
    });
    dialog->open();
}

} // namespace posewire::gui
