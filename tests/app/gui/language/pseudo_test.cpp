// SPDX-License-Identifier: GPL-3.0-or-later
// Every text of the window comes through the translator, and has room when it is 40 % longer.
#include "app/gui/base/dock_layout.h"
#include "app/gui/panels/panels.h"
#include "app/gui/theme/language.h"
#include "app/gui/window/docks.h"
#include "app/gui/window/main_window.h"
#include "app/gui/window/verdict_bar.h"
#include "app/net/datagram_sender.h"
#include "core/model/body/joint_ranges.h"
#include "core/model/body/points.h"
#include "core/model/body/pose_difference.h"
#include "core/model/body/segments.h"
#include "core/model/session/roster.h"
#include "core/performer/performer.h"
#include "core/wire/type_table.h"

#include <gtest/gtest.h>

#include <QAbstractButton>
#include <QAbstractItemView>
#include <QAction>
#include <QComboBox>
#include <QDialog>
#include <QDockWidget>
#include <QDoubleSpinBox>
#include <QGroupBox>
#include <QLabel>
#include <QLineEdit>
#include <QMenu>
#include <QPaintDevice>
#include <QPaintEngine>
#include <QRegularExpression>
#include <QSpinBox>
#include <QTabBar>
#include <QTemporaryDir>
#include <QTest>
#include <QTextBrowser>
#include <QTextDocument>
#include <QTimer>
#include <QToolButton>

#include <set>

namespace posewire::gui {
namespace {

constexpr int kCharacters = 2;

void addName(std::string_view name, QSet<QString>& names) {
    static const QRegularExpression part("[A-Z]?[a-z]+|[A-Z]+");
    for (auto match = part.globalMatch(QString::fromUtf8(name.data(), static_cast<qsizetype>(name.size())));
         match.hasNext();) {
        names.insert(match.next().captured().toLower());
    }
    names.insert(QString::fromUtf8(name.data(), static_cast<qsizetype>(name.size())).toLower());
}

void addFieldNames(std::span<const wire::FieldRow> rows, QSet<QString>& names) {
    for (const wire::FieldRow& row : rows) {
        addName(row.about.name, names);
        for (const wire::FieldPart& part : row.about.parts) {
            addName(part.name, names);
        }
        addFieldNames(row.items, names);
    }
}

/// Fields of the wire format, which only the inspector names, in small letters.
const QSet<QString>& fieldNames() {
    static const QSet<QString> kNames = [] {
        QSet<QString> names{"uint8",      "uint16", "uint32", "int32", "float32",
                            "characters", "text",   "header", "yes",   "bytes"};
        addFieldNames(wire::headerRows(), names);
        for (const wire::TypeInfo& type : wire::typeTable()) {
            for (const wire::FormRow& form : type.forms) {
                addFieldNames(form.fields, names);
            }
        }
        return names;
    }();
    return kNames;
}

/// What products, formats, senders and the specification call by name, in small letters.
const QSet<QString>& foreignNames() {
    static const QSet<QString> kNames = [] {
        QSet<QString> names{
            "posewire",   "mira",        "lindqvist",  "jonas",    "adeyemi",   "sword",   "name",   "color",
            "count",      "xmid",        "timeoffset", "json",     "udp",       "take",    "pcapng", "mixamo",
            "unreal",     "unity",       "vroid",      "blender",  "character", "creator", "rigify", "biped",
            "humanoid",   "studio",      "max",        "jsonl",    "assimp",    "cyclone", "eigen",  "epoxy",
            "liblo",      "libpng",      "nats",       "zlib",     "nlohmann",  "mit",     "cli11",  "re2",
            "prometheus", "qcustomplot", "expected",   "unlicense"};
        for (int place = 0; place < model::kAllSegments.count(); ++place) {
            addName(model::segmentName(model::kAllSegments, place), names);
            addName(model::segmentTitle(model::kAllSegments, place), names);
        }
        for (const model::JointDefinition& joint : model::jointDefinitions()) {
            addName(joint.name, names);
        }
        for (const model::AnatomicalPoint& point : model::anatomicalPoints()) {
            addName(point.name, names);
        }
        addName(model::kRangeSource, names);
        return names;
    }();
    return kNames;
}

/// Words of at least three letters with plain vowels: the translator leaves none.
QStringList untranslated(QString text, bool isOfInspector) {
    if (Qt::mightBeRichText(text)) {
        QTextDocument document;
        document.setHtml(text);
        text = document.toPlainText();
    }
    static const QRegularExpression placeholder("\\{\\w+\\}");
    static const QRegularExpression filter("^\\w+ (in|\\|\\||[<>=]) ");
    if (filter.match(text).hasMatch()) {
        return {};
    }
    static const QRegularExpression word("\\p{L}[\\p{L}\\d_]{2,}");
    static const QRegularExpression plain("^[A-Za-z\\d_]*[aeiouyAEIOUY][A-Za-z\\d_]*$");
    static const QRegularExpression licence(
        QStringLiteral("\\w+[-\u2011]\\d[\\w.]*([-\u2011][\\w.]+)*")); // "GPL-3.0-or-later"
    text.remove('&').remove(placeholder).remove(licence);
    QStringList found;
    for (auto match = word.globalMatch(text); match.hasNext();) {
        const QString one = match.next().captured();
        if (plain.match(one).hasMatch() && !foreignNames().contains(one.toLower()) &&
            !(isOfInspector && fieldNames().contains(one.toLower()))) {
            found += one;
        }
    }
    return found;
}

/// Keeps each text that is painted, and nothing else.
class PaintedTexts final : public QPaintDevice {
public:
    explicit PaintedTexts(const QSize& size) : m_size(size) {}

    [[nodiscard]] QPaintEngine* paintEngine() const override { return &m_engine; }
    [[nodiscard]] const QStringList& texts() const { return m_engine.texts; }

protected:
    [[nodiscard]] int metric(PaintDeviceMetric metric) const override {
        switch (metric) {
        case PdmWidth:
        case PdmWidthMM:
            return m_size.width();
        case PdmHeight:
        case PdmHeightMM:
            return m_size.height();
        case PdmDpiX:
        case PdmDpiY:
        case PdmPhysicalDpiX:
        case PdmPhysicalDpiY:
            return 96;
        case PdmDevicePixelRatioScaled:
            return static_cast<int>(devicePixelRatioFScale());
        default:
            return 1;
        }
    }

private:
    struct Engine final : QPaintEngine {
        Engine() : QPaintEngine(AllFeatures) {}
        bool begin(QPaintDevice* /*device*/) override { return true; }
        bool end() override { return true; }
        void updateState(const QPaintEngineState& /*state*/) override {}
        void drawPath(const QPainterPath& /*path*/) override {}
        void drawPolygon(const QPointF* /*points*/, int /*count*/, PolygonDrawMode /*mode*/) override {}
        void drawPolygon(const QPoint* /*points*/, int /*count*/, PolygonDrawMode /*mode*/) override {}
        void drawPixmap(const QRectF& /*to*/, const QPixmap& /*pixmap*/, const QRectF& /*from*/) override {}
        void drawImage(const QRectF& /*to*/, const QImage& /*image*/, const QRectF& /*from*/,
                       Qt::ImageConversionFlags /*flags*/) override {}
        void drawTextItem(const QPointF& /*place*/, const QTextItem& item) override { texts += item.text(); }
        [[nodiscard]] Type type() const override { return User; }
        QStringList texts;
    };
    QSize m_size;
    mutable Engine m_engine;
};

class PseudoTest : public testing::Test {
protected:
    static void SetUpTestSuite() { useLanguage(kPseudoLanguage); }

    PseudoTest() {
        m_window.resize(1280, 720);
        m_window.show();
    }

    /// Two characters with everything that a sender may send, gaps, and what is none of it.
    void receive() {
        m_driver.receiving().addPort({"127.0.0.1", 0});
        auto sender = net::DatagramSender::connect(
            {{"127.0.0.1", m_driver.receiving().openPort()}, net::SendTarget::Transport::Udp});
        ASSERT_TRUE(sender);
        performer::PerformerSettings settings;
        settings.characters = kCharacters;
        settings.props = 1;
        performer::Performer performer(settings);
        for (std::uint64_t frame = 0; frame < 60; ++frame) {
            for (const wire::Datagram& datagram : performer.frame(frame)) {
                std::vector<std::byte> bytes = *wire::encode(datagram);
                bytes.resize(frame % 16 == 5 ? bytes.size() - 7 : bytes.size());
                ASSERT_TRUE(frame % 10 == 7 || sender->send(bytes));
            }
            m_driver.tick();
        }
        ASSERT_TRUE(sender->send(std::as_bytes(std::span("GET / HTTP/1.1"))));
        ASSERT_TRUE(QTest::qWaitFor([this] {
            refresh();
            return m_driver.commands().live().atNow().roster().listed().size() == kCharacters;
        }));
        const model::CharacterKey key = m_driver.commands().live().atNow().roster().listed()[0]->key;
        m_driver.commands().select({key.sender, key, 3});
    }

    void refresh() {
        m_driver.tick();
        emit m_driver.tableTick();
        m_window.docks().refresh();
        QTest::qWait(5);
    }

    void check(const QString& text, const QString& where) {
        if (const QStringList words = untranslated(text, where.contains("inspector")); !words.isEmpty()) {
            m_found.insert(
                (where + ": [" + words.join(' ') + "] " + text.left(160).replace('\n', ' ')).toStdString());
        }
    }

    void checkModel(const QAbstractItemModel& model, const QModelIndex& parent, const QString& where) {
        for (int column = 0; parent == QModelIndex() && column < model.columnCount(); ++column) {
            for (const int role : {Qt::DisplayRole, Qt::ToolTipRole}) {
                check(model.headerData(column, Qt::Horizontal, role).toString(), where + " header");
            }
        }
        for (int row = 0; row < std::min(model.rowCount(parent), 80); ++row) {
            for (int column = 0; column < model.columnCount(parent); ++column) {
                const QModelIndex index = model.index(row, column, parent);
                for (const int role : {Qt::DisplayRole, Qt::ToolTipRole, Qt::AccessibleTextRole}) {
                    check(index.data(role).toString(), where + QStringLiteral(" column %1").arg(column));
                }
            }
            if (const QModelIndex first = model.index(row, 0, parent); model.hasChildren(first)) {
                checkModel(model, first, where);
            }
        }
    }

    void checkMenu(QMenu& menu, const QString& where) {
        emit menu.aboutToShow();
        for (QAction* action : menu.actions()) {
            check(action->text(), where + " menu");
            check(action->toolTip(), where + " menu");
            if (action->menu() != nullptr) {
                checkMenu(*action->menu(), where + '/' + action->text());
            }
        }
    }

    void checkTexts(QWidget& widget, const QString& where) {
        check(widget.toolTip(), where);
        check(widget.accessibleName(), where);
        check(widget.accessibleDescription(), where);
        check(widget.windowTitle(), where);
        for (const char* property :
             {"text", "title", "placeholderText", "prefix", "suffix", "specialValueText"}) {
            if (qobject_cast<QLineEdit*>(&widget) == nullptr || qstrcmp(property, "text") != 0) {
                check(widget.property(property).toString(), where + ' ' + property);
            }
        }
        if (auto* box = qobject_cast<QComboBox*>(&widget)) {
            checkModel(*box->model(), {}, where);
        } else if (auto* view = qobject_cast<QAbstractItemView*>(&widget); view != nullptr && view->model()) {
            checkModel(*view->model(), {}, where);
        } else if (auto* tabs = qobject_cast<QTabBar*>(&widget)) {
            for (int tab = 0; tab < tabs->count(); ++tab) {
                check(tabs->tabText(tab), where);
                check(tabs->tabToolTip(tab), where);
            }
        } else if (auto* browser = qobject_cast<QTextBrowser*>(&widget)) {
            check(browser->toPlainText(), where);
        } else if (auto* button = qobject_cast<QToolButton*>(&widget); button != nullptr && button->menu()) {
            checkMenu(*button->menu(), where);
        }
    }

    /// Plots, lists and others that paint their texts themselves.
    void checkPainted(QWidget& widget, const QString& where) {
        static const QRegularExpression elided("\\p{L}+…"); // a name may be: the translator leaves no vowel
        if (widget.isVisible() && !widget.inherits("QOpenGLWidget") && !widget.inherits("QLineEdit")) {
            PaintedTexts painted(widget.size());
            widget.render(&painted, {}, {}, {});
            for (QString text : painted.texts()) {
                check(text.remove(elided), where + " painted");
            }
        }
    }

    /// Labels and buttons that do not elide.
    void checkRoom(const QWidget& widget, const QString& where) {
        const auto* label = qobject_cast<const QLabel*>(&widget);
        const auto* button = qobject_cast<const QAbstractButton*>(&widget);
        if (!widget.isVisible() || (label == nullptr && button == nullptr) ||
            widget.visibleRegion().isEmpty() || qobject_cast<const Headline*>(&widget) != nullptr) {
            return;
        }
        const bool isWrapped = label != nullptr && label->wordWrap();
        const QSize needed =
            isWrapped ? QSize(0, label->heightForWidth(widget.width())) : widget.minimumSizeHint();
        if (needed.width() > widget.width() || needed.height() > widget.height()) {
            m_cut.insert(QStringLiteral("%1 has %2 x %3, needs %4 x %5: %6")
                             .arg(where)
                             .arg(widget.width())
                             .arg(widget.height())
                             .arg(needed.width())
                             .arg(needed.height())
                             .arg(widget.property("text").toString().left(80))
                             .toStdString());
        }
    }

    void checkAll(QWidget& root) {
        QList<QWidget*> widgets = root.findChildren<QWidget*>();
        widgets.prepend(&root);
        for (QWidget* widget : widgets) {
            QStringList path;
            for (const QWidget* one = widget; one != nullptr; one = one->parentWidget()) {
                if (!one->objectName().isEmpty() && path.size() < 3) {
                    path.prepend(one->objectName());
                }
            }
            const QString where = path.join('>') + ' ' + widget->metaObject()->className();
            checkTexts(*widget, where);
            checkRoom(*widget, where);
            checkPainted(*widget, where);
            for (const QAction* action : widget->actions()) {
                check(action->text(), where + " action");
                check(action->toolTip(), where + " action");
            }
        }
    }

    void expectAllTranslated() {
        std::string all;
        for (const std::string& one : m_found) {
            all += one + '\n';
        }
        EXPECT_EQ(all, "") << m_found.size();
        all.clear();
        for (const std::string& one : m_cut) {
            all += one + '\n';
        }
        EXPECT_EQ(all, "") << m_cut.size();
    }

    QTemporaryDir m_folder;
    SettingsFile m_file{m_folder.filePath("settings.json")};
    log::SystemClock m_clock;
    SessionDriver m_driver{m_clock};
    MainWindow m_window{m_driver, m_file, {}};
    std::set<std::string> m_found;
    std::set<std::string> m_cut;
};

TEST_F(PseudoTest, TranslatesWhatIsShownBeforeAnythingCame) {
    for (const PanelInfo& panel : panelTable()) {
        m_window.docks().show(panel.id);
        refresh();
        checkAll(m_window);
    }
    expectAllTranslated();
}

TEST_F(PseudoTest, TranslatesEveryDock) {
    receive();
    for (const PanelInfo& panel : panelTable()) {
        m_window.docks().show(panel.id);
        refresh();
        checkAll(m_window);
    }
    expectAllTranslated();
}

TEST_F(PseudoTest, TranslatesEveryLayout) {
    receive();
    for (const QString& layout : layoutNames()) {
        m_window.useLayout(layout);
        refresh();
        checkAll(m_window);
    }
    expectAllTranslated();
}

TEST_F(PseudoTest, TranslatesEveryMenuAndDialog) {
    receive();
    for (QMenu* menu : m_window.findChildren<QMenu*>()) {
        checkMenu(*menu, menu->objectName());
    }
    QTimer closing; // dialogs that wait for an answer
    QObject::connect(&closing, &QTimer::timeout, &m_window, [this] {
        for (QWidget* shown : QApplication::topLevelWidgets()) {
            if (shown != &m_window && shown->isVisible() && shown->isWindow()) {
                checkAll(*shown);
                shown->close();
            }
        }
    });
    closing.start(30);
    for (const QString id :
         {"inputs", "preferences", "thresholds", "recordingOptions", "replay", "recovered", "history",
          "exportMotion", "exportPictures", "ownCharacter", "findCommand", "about", "connectionHelp"}) {
        auto* action = m_window.findChild<QAction*>(id);
        ASSERT_NE(action, nullptr) << id.toStdString();
        action->trigger();
        QTest::qWait(80);
    }
    expectAllTranslated();
}

} // namespace
} // namespace posewire::gui
