// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/window/docks.h"

#include "app/gui/base/dock_layout.h"
#include "app/gui/driver/session_driver.h"
#include "app/gui/theme/event_watch.h"
#include "app/gui/theme/help_link.h"
#include "app/gui/theme/theme.h"
#include "app/gui/theme/widgets.h"
#include "app/gui/theme/words.h"

#include <QAbstractItemView>
#include <QAction>
#include <QApplication>
#include <QDockWidget>
#include <QMainWindow>
#include <QMenu>
#include <QPainter>
#include <QScreen>
#include <QScrollArea>

#include <algorithm>
#include <utility>

namespace posewire::gui {

namespace {

constexpr int kLeastLines = 3;
constexpr int kKeyboardMark = 3;

class DockScroll final : public QScrollArea {
public:
    DockScroll(QWidget* content, QWidget* parent) : QScrollArea(parent) {
        setFrameShape(QFrame::NoFrame);
        setFocusPolicy(Qt::NoFocus);
        setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
        setWidget(content);
    }

    [[nodiscard]] QSize sizeHint() const override {
        return widget()->sizeHint().expandedTo(minimumSizeHint());
    }
    [[nodiscard]] QSize minimumSizeHint() const override {
        const QSize content = widget()->minimumSizeHint();
        return {content.width(), std::min(content.height(), fontMetrics().height() * kLeastLines)};
    }

protected:
    bool eventFilter(QObject* watched, QEvent* event) override {
        const bool isDone = QScrollArea::eventFilter(watched, event);
        if (watched == widget() && event->type() == QEvent::LayoutRequest) {
            fitContent();
            updateGeometry();
        }
        return isDone;
    }
    void resizeEvent(QResizeEvent* event) override {
        QScrollArea::resizeEvent(event);
        fitContent();
    }

private:
    /// QScrollArea's own fitting would give content with wrapped texts the height it likes best.
    void fitContent() {
        const int width = viewport()->width();
        const QLayout* layout = widget()->layout();
        const bool isWrapping = layout != nullptr && layout->hasHeightForWidth();
        const int least =
            isWrapping ? layout->totalMinimumHeightForWidth(width) : widget()->minimumSizeHint().height();
        widget()->resize(width, std::max(maximumViewportSize().height(), least));
    }
};

/// What takes the keyboard first within a part of the window; the part itself where nothing does.
QWidget* firstStop(QWidget* part) {
    const QList<QWidget*> children = part->findChildren<QWidget*>();
    const auto found = std::ranges::find_if(children, [](const QWidget* child) {
        return child->isVisible() && child->isEnabled() && (child->focusPolicy() & Qt::TabFocus) != 0;
    });
    return found == children.end() ? part : *found;
}

/// Where the keyboard is of most use in a dock: its table; what takes it first where there is none.
QWidget* mainStop(QWidget* panel) {
    const QList<QAbstractItemView*> tables = panel->findChildren<QAbstractItemView*>();
    const auto found = std::ranges::find_if(tables, [](const QWidget* table) {
        return table->isVisible() && (table->focusPolicy() & Qt::TabFocus) != 0;
    });
    return found == tables.end() ? firstStop(panel) : *found;
}

/// On one screen, or on several side by side.
bool isAllSeen(const QRect& window) {
    QRegion hidden(window);
    for (const QScreen* screen : QGuiApplication::screens()) {
        hidden -= screen->availableGeometry();
    }
    return hidden.isEmpty();
}

/// As far as it has to be, and as large as it may be.
QRect movedInto(const QRect& room, const QRect& window) {
    QRect moved(window.topLeft(), window.size().boundedTo(room.size()));
    moved.moveRight(std::min(moved.right(), room.right()));
    moved.moveBottom(std::min(moved.bottom(), room.bottom()));
    moved.moveLeft(std::max(moved.left(), room.left()));
    return moved;
}

} // namespace

/// The title of a dock: its name, a short summary at the right, "?" that opens its page of the guide, and
/// under the pointer what floats and closes it. An edge shows where the keyboard is.
class DockTitle final : public QWidget {
public:
    /// The dock has its object name already: the page is called so.
    explicit DockTitle(QDockWidget* dock)
        : QWidget(dock),
          m_title(plainLabel(dock->windowTitle(), this)),
          m_help(helpButton(dock->windowTitle(), dock->objectName(), this)) {
        auto* row = spacedRow({10, 0, 8, 1}, 2, this);
        row->addWidget(m_title);
        row->addSpacing(8);
        row->addWidget(m_summary, 1);
        row->addSpacing(2);
        // Those that come with the pointer are before the one that is always there, or they would slip under
        // it.
        row->addWidget(m_float);
        row->addWidget(m_close);
        row->addWidget(m_help);
        for (QToolButton* button : {m_float, m_close}) {
            button->setFocusPolicy(Qt::NoFocus);
            button->hide();
        }
        connect(m_float, &QToolButton::clicked, dock, [dock] { dock->setFloating(!dock->isFloating()); });
        connect(m_close, &QToolButton::clicked, dock, &QDockWidget::close);
        connect(qApp, &QApplication::focusChanged, this, [this] { update(); });
        new EventWatch(this, QEvent::PaletteChange, [this] { restyle(); });
        new EventWatch(dock, QEvent::Paint,
                       [dock] { // afloat it has no other edge, and lies on what looks the same
                           if (dock->isFloating()) {
                               QPainter(dock).fillRect(dock->rect(), theme().dim);
                           }
                       });
        new EventWatch(this, QEvent::Enter, [this] { showButtons(true); });
        new EventWatch(this, QEvent::Leave, [this] { showButtons(false); });
        restyle();
    }

    void setSummary(const QString& summary) { m_summary->setText({}, summary); }
    /// A tab says the name already.
    void setTabbed(bool isTabbed) {
        if (isTabbed == m_title->isVisibleTo(this)) {
            m_title->setVisible(!isTabbed);
            m_summary->setAlignment(isTabbed ? Qt::AlignLeft : Qt::AlignRight);
        }
    }

    /// QDockWidget makes as much room as is said here, whatever the widget's fixed height.
    [[nodiscard]] QSize sizeHint() const override {
        return {QWidget::sizeHint().width(), fontMetrics().height() + 13};
    }
    [[nodiscard]] QSize minimumSizeHint() const override {
        return {m_title->sizeHint().width() + m_help->sizeHint().width() + 24, sizeHint().height()};
    }

protected:
    void paintEvent(QPaintEvent* /*event*/) override {
        QPainter painter(this);
        painter.fillRect(rect(), theme().header);
        painter.fillRect(QRect(0, height() - 1, width(), 1), theme().line);
        if (parentWidget()->isAncestorOf(QApplication::focusWidget())) {
            painter.fillRect(QRect(0, 0, kKeyboardMark, height() - 1), theme().accent);
        }
    }

private:
    void restyle() {
        QFont font = this->font();
        font.setWeight(QFont::DemiBold);
        m_title->setFont(font);
        m_summary->setFont(tabularFont());
        const QColor sign = theme().dim;
        QPalette dim = palette();
        dim.setColor(QPalette::ButtonText, sign);
        m_help->setPalette(dim);
        m_help->setFont(font);
        const int side = fontMetrics().height() - 2;
        for (auto* button : {m_float, m_close}) {
            button->setIconSize({side, side});
        }
        m_float->setIcon(themedIcon(QStringLiteral("float"), sign));
        m_close->setIcon(themedIcon(QStringLiteral("close"), sign));
        updateGeometry();
    }
    void showButtons(bool isShown) {
        m_float->setVisible(isShown);
        m_close->setVisible(isShown);
    }

    QLabel* m_title;
    ElidedLabel* m_summary = new ElidedLabel(Qt::AlignRight, this);
    QToolButton* m_help;
    QToolButton* m_float = flatButton({}, tr("Float or dock"), this);
    QToolButton* m_close = flatButton({}, tr("Close"), this);
};

QRect onScreen(const QRect& window) {
    constexpr int kGrabbable = 80;
    if (window.width() < kGrabbable || window.height() < kGrabbable) {
        return {};
    }
    for (const QScreen* screen : QGuiApplication::screens()) {
        const QRect room = screen->availableGeometry();
        const QRect seen = room.intersected(window);
        if (seen.width() >= kGrabbable && seen.height() >= kGrabbable && window.top() >= room.top()) {
            return isAllSeen(window) ? window : movedInto(room, window);
        }
    }
    return {};
}

Docks::Docks(SessionDriver& driver, QMainWindow& window, QMenu& menu, const QJsonObject& states)
    : QObject(&window), m_driver(driver), m_window(window) {
    QAction* before = menu.actions().value(0);
    for (const PanelInfo& info : panelTable()) {
        add(info, states[QLatin1String(info.id)].toObject());
        menu.insertAction(before, actionFor(QLatin1String(info.id)));
    }
    menu.insertSeparator(before);
}

void Docks::add(const PanelInfo& info, const QJsonObject& state) {
    auto* dock = new QDockWidget(QCoreApplication::translate("Panel", info.title), &m_window);
    dock->setObjectName(QLatin1String(info.id));
    setHelpPlace(*dock, dock->objectName());
    const Page page = makePage(info, dock);
    page.panel->restoreState(state);
    dock->setWidget(page.scroll);
    auto* title = new DockTitle(dock);
    dock->setTitleBarWidget(title);
    m_window.addDockWidget(info.area, dock);
    dock->hide(); // the layout says which ones show: all of them would make the window too wide
    m_docks.push_back({&info, dock, title, page, {}, page.panel});
    connect(dock, &QDockWidget::visibilityChanged, this, [this, i = m_docks.size() - 1](bool isVisible) {
        if (isVisible) {
            m_docks[i].panel->refresh();
        }
    });
}

Docks::Page Docks::makePage(const PanelInfo& info, QDockWidget* dock) {
    Panel* panel =
        info.make({m_driver.commands().session(), m_driver.commands(), m_driver.playback(),
                   m_driver.files().comparing(), m_driver.receiving().state(), m_driver.health().health()},
                  dock);
    return {new DockScroll(panel, dock), panel};
}

QJsonObject Docks::states(QJsonObject before) const {
    for (const Dock& dock : m_docks) {
        if (const QJsonObject state = dock.panel->state(); !state.isEmpty()) {
            before[dock.dock->objectName()] = state;
        } else {
            before.remove(dock.dock->objectName());
        }
    }
    return before;
}

Panel& Docks::panelOf(const PanelInfo& info) const {
    return *std::ranges::find(m_docks, &info, &Dock::info)->panel;
}

/// What the operator set in a dock is of the dock: it goes along from page to page.
void Docks::showSession() {
    const bool isFile = m_driver.commands().isFileShown();
    for (Dock& dock : m_docks) {
        if (isFile && dock.file.panel == nullptr) {
            dock.file = makePage(*dock.info, dock.dock);
        }
        const Page& page = isFile ? dock.file : dock.live;
        if (page.panel != dock.panel) {
            page.panel->restoreState(dock.panel->state());
        }
        dock.dock->setWidget(page.scroll);
        page.scroll->show();
        dock.panel = page.panel;
    }
}

void Docks::forgetFile() {
    for (Dock& dock : m_docks) {
        delete std::exchange(dock.file, {}).scroll;
    }
}

void Docks::refresh() {
    for (const Dock& dock : m_docks) {
        const bool isInSight = dock.isInSight();
        if (isInSight) {
            dock.panel->refresh();
            dock.title->setSummary(dock.panel->summary());
            dock.title->setTabbed(!m_window.tabifiedDockWidgets(dock.dock).isEmpty());
        }
        for (Panel* panel : {dock.live.panel, dock.file.panel}) {
            const bool isDone = isInSight && panel == dock.panel;
            if (panel != nullptr && panel->hasWindow() && !isDone) {
                panel->refresh();
            }
        }
    }
}

bool Docks::Dock::isInSight() const {
    // A dock behind another as a tab is not hidden but beside its window. What it covers with its own
    // children says nothing: visibleRegion() is empty also where those are opaque.
    return panel->isVisible() &&
           (dock->isWindow() || dock->parentWidget()->rect().intersects(dock->geometry()));
}

const Docks::Dock* Docks::find(const QString& name) const {
    const auto found =
        std::ranges::find(m_docks, name, [](const Dock& each) { return each.dock->objectName(); });
    return found == m_docks.end() ? nullptr : &*found;
}

/// The keyboard goes along if the dock that has it is covered: else nobody sees what keys do.
void Docks::show(const QString& name) {
    const Dock* found = find(name);
    if (found == nullptr) {
        return;
    }
    const auto with = std::ranges::find_if(
        m_docks, [this](const Dock& each) { return each.dock->isAncestorOf(m_window.focusWidget()); });
    placeDock(*found->dock, found->info->area, m_window);
    found->dock->show();
    const bool isCovered = with != m_docks.end() && with->dock != found->dock &&
                           m_window.tabifiedDockWidgets(found->dock).contains(with->dock);
    found->dock->raise();
    if (isCovered) {
        mainStop(found->panel)->setFocus();
    }
}

void Docks::showEvidence(std::optional<std::uint64_t> incident, bool isOfFile) {
    if (!isOfFile) {
        m_driver.commands().showLive();
    }
    m_driver.commands().showIncident(incident);
    mainStop(find(QStringLiteral("events"))->panel)->setFocus();
}

QWidget* Docks::showPart(const QString& name) {
    auto* part = m_window.findChild<QWidget*>(name);
    for (const Dock& dock : m_docks) {
        if (part == dock.dock || dock.dock->isAncestorOf(part)) {
            show(dock.dock->objectName());
            refresh();
        }
    }
    return part;
}

void Docks::coverBy(const QString& name) {
    std::vector<const Dock*> inSight;
    for (const Dock& dock : m_docks) {
        if (dock.isInSight()) {
            inSight.push_back(&dock);
        }
    }
    show(name);
    const Dock* dock = find(name);
    m_covered = nullptr;
    if (dock == nullptr || std::ranges::count(inSight, dock) != 0) {
        return;
    }
    const QList<QDockWidget*> tabs = m_window.tabifiedDockWidgets(dock->dock);
    for (const Dock* before : inSight) {
        m_covered = tabs.contains(before->dock) ? before : m_covered;
    }
}

void Docks::uncover() {
    if (const Dock* dock = std::exchange(m_covered, nullptr)) {
        dock->dock->raise();
        mainStop(dock->panel)->setFocus();
    }
}

void Docks::enter(const QString& name) {
    show(name);
    mainStop(find(name)->panel)->setFocus();
}

QAction* Docks::actionFor(const QString& name) {
    QDockWidget* dock = find(name)->dock;
    auto* action = new QAction(dock->windowTitle(), dock);
    action->setCheckable(true);
    const auto showState = [dock, action] { action->setChecked(dock->toggleViewAction()->isChecked()); };
    connect(dock->toggleViewAction(), &QAction::toggled, action, showState);
    connect(action, &QAction::triggered, this, [this, name, showState] {
        const Dock* toggled = find(name);
        if (toggled->isInSight()) {
            toggled->dock->close();
        } else {
            enter(name);
        }
        showState();
    });
    return action;
}

void Docks::dockAll() {
    for (const Dock& dock : m_docks) {
        dock.dock->setFloating(false);
    }
    if (onScreen(m_window.geometry()).isEmpty()) {
        m_window.move(m_window.screen()->availableGeometry().topLeft());
    }
}

void Docks::dockUnseen() {
    for (const Dock& dock : m_docks) {
        if (dock.dock->isFloating() && onScreen(dock.dock->geometry()).isEmpty()) {
            dock.dock->setFloating(false);
        }
    }
}

void Docks::moveFocus(int direction, QWidget& first, QWidget* last) {
    std::vector<QWidget*> stops{&first};
    for (const Dock& dock : m_docks) {
        if (dock.panel->isVisible()) {
            stops.push_back(dock.dock);
        }
    }
    if (last != nullptr) {
        stops.push_back(last);
    }
    const auto now = std::ranges::find_if(
        stops, [](const QWidget* stop) { return stop->isAncestorOf(QApplication::focusWidget()); });
    const std::size_t current = now == stops.end() ? 0 : static_cast<std::size_t>(now - stops.begin());
    const std::size_t step = direction < 0 ? stops.size() - 1 : 1;
    QWidget* next = stops[(current + step) % stops.size()];
    if (const Dock* dock = find(next->objectName())) {
        dock->dock->raise();
        next = dock->panel;
    }
    (next == &first ? next : firstStop(next))->setFocus(Qt::TabFocusReason);
}

} // namespace posewire::gui
