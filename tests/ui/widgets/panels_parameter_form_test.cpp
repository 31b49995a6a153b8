#include <QCheckBox>
#include <QComboBox>
#include <QLabel>
#include <QLineEdit>
#include <QSignalSpy>
#include <QSpinBox>
#include <QTest>
#include <QToolButton>
#include <QWheelEvent>

#include "core/error.h"
#include "panels_support.h"
#include "ui/support/ui_test.h"
#include "widgets/parameters/parameter_form.h"
#include "widgets/parameters/parameter_row.h"
#include "widgets/real_spin_box.h"

namespace eyrie::ui::panels_parameter_form_test {

namespace {

enum class Method { clusters, gradient, none };

/// Stands for the options of the chain.
struct Options {
    double min_speed = 0.0066667;
    double radius = 3;
    int layers = 50;
    bool fuse = true;
    Method method = Method::gradient;

    void describe(ParameterVisitor& visitor) {
        const ParameterDeclarer declare(visitor, ChainStage::none);
        declare.real("motion.min_speed", min_speed, 0, 10, {"m/s", "Slowest motion that counts.", "Teutsch §5.2"});
        declare.integer("stacking.layers", layers, 1, 500, {"layers", "Height of the image stack.", "Teutsch §5.3"});
        declare.real("motion.link_radius", radius, 0.5, 1e6, {"m", "Corners closer than this are linked.", ""});
        declare.flag("removal.fuse", fuse, {"", "Duplicates are fused by union.", "Teutsch §5.5.1"});
        declare.choice("detection.method", method, {"clusters", "gradient", "none"},
                       {"", "How objects are outlined.", ""});
    }
};

std::vector<Parameter> list(Options options = {}) {
    return listParameters(describeOf(options));
}

ParameterRow* row(ParameterForm& form, const char* name) {
    for (ParameterRow* found : form.findChildren<ParameterRow*>()) {
        if (found->name() == QLatin1String(name)) return found;
    }
    return nullptr;
}

template <class Field>
Field* field(ParameterForm& form, const char* name) {
    return row(form, name)->findChild<Field*>();
}

QStringList shownRows(ParameterForm& form) {
    QStringList names;
    for (const ParameterRow* found : form.findChildren<ParameterRow*>()) {
        if (found->isVisibleTo(&form)) names << found->name();
    }
    return names;
}

void type(QWidget* field, const QString& text) {
    field->setFocus();
    auto* edit = field->findChild<QLineEdit*>();
    edit->selectAll();
    QTest::keyClicks(edit, text);
    QTest::keyClick(field, Qt::Key_Return);
}

}  // namespace

class ParameterFormTest : public QObject {
    Q_OBJECT

 private slots:
    void initTestCase() { QLocale::setDefault(QLocale::c()); }

    void everyParameterHasItsRow() {
        ParameterForm form;
        form.setParameters(list(), list());
        QCOMPARE(form.values().size(), std::size_t{5});
        QVERIFY(field<RealSpinBox>(form, "motion.min_speed") != nullptr);
        QVERIFY(field<QSpinBox>(form, "stacking.layers") != nullptr);
        QVERIFY(field<QCheckBox>(form, "removal.fuse")->isChecked());
        QCOMPARE(field<QComboBox>(form, "detection.method")->currentText(), QStringLiteral("gradient"));
        QVERIFY(!form.isModified());
        const QString help = row(form, "motion.min_speed")->toolTip();
        for (const char* part : {"Slowest motion", "Teutsch §5.2", "0..10 m/s", "0.0066667"}) {
            QVERIFY2(help.contains(QString::fromUtf8(part)), part);
        }
    }

    // The fault this form must not have: opening it must not change what nobody edited.
    void nothingIsRoundedThatNobodyEdited() {
        ParameterForm form;
        QSignalSpy changes(&form, &ParameterForm::valueChanged);
        Options options;
        options.min_speed = 0.006666666666666667;
        options.radius = 123456.78901234567;
        const auto before = list(options);
        form.setParameters(before, list());
        form.show();
        QVERIFY(QTest::qWaitForWindowExposed(&form));
        for (auto* spin : form.findChildren<QAbstractSpinBox*>()) {
            spin->setFocus();
            QTest::keyClick(spin, Qt::Key_Return);
            QTest::keyClick(spin, Qt::Key_Tab);
        }
        form.hide();
        QCOMPARE(changes.count(), 0);
        for (std::size_t i = 0; i < before.size(); ++i) QCOMPARE(form.values()[i].second, before[i].value);
    }

    void anEditIsTold() {
        ParameterForm form;
        form.setParameters(list(), list());
        form.show();
        QSignalSpy changes(&form, &ParameterForm::valueChanged);
        type(field<RealSpinBox>(form, "motion.min_speed"), QStringLiteral("0.250"));
        QCOMPARE(changes.count(), 1);
        QCOMPARE(changes[0][0].toString(), QStringLiteral("motion.min_speed"));
        QCOMPARE(changes[0][1].toString(), QStringLiteral("0.25"));
        type(field<QSpinBox>(form, "stacking.layers"), QStringLiteral("60"));
        QCOMPARE(changes.last()[1].toString(), QStringLiteral("60"));
        field<QCheckBox>(form, "removal.fuse")->click();
        QCOMPARE(changes.last()[1].toString(), QStringLiteral("false"));
        auto* choice = field<QComboBox>(form, "detection.method");
        choice->setFocus();
        QTest::keyClick(choice, Qt::Key_Down);
        QCOMPARE(changes.last()[1].toString(), QStringLiteral("none"));
        QCOMPARE(changes.count(), 4);

        // What the form tells, the engine accepts.
        Options options;
        for (const auto& [name, value] : form.values()) setParameter(describeOf(options), name, value);
        QCOMPARE(options.min_speed, 0.25);
        QCOMPARE(options.layers, 60);
        QCOMPARE(options.fuse, false);
        QVERIFY(options.method == Method::none);
        QCOMPARE(options.radius, 3.0);
    }

    void aValueOutsideIsClampedAndNonsenseIsTakenBack() {
        ParameterForm form;
        form.setParameters(list(), list());
        form.show();
        QSignalSpy changes(&form, &ParameterForm::valueChanged);
        auto* speed = field<RealSpinBox>(form, "motion.min_speed");
        type(speed, QStringLiteral("99"));
        QCOMPARE(speed->valueText(), QStringLiteral("10"));
        type(speed, QStringLiteral("1,5"));
        QCOMPARE(speed->valueText(), QStringLiteral("1.5"));
        changes.clear();
        type(speed, QStringLiteral("1e"));
        QCOMPARE(speed->valueText(), QStringLiteral("1.5"));
        QCOMPARE(speed->findChild<QLineEdit*>()->text(), QStringLiteral("1.5"));
        speed->findChild<QLineEdit*>()->selectAll();
        QTest::keyClicks(speed->findChild<QLineEdit*>(), QStringLiteral("7"));
        QTest::keyClick(speed, Qt::Key_Escape);
        QCOMPARE(speed->findChild<QLineEdit*>()->text(), QStringLiteral("1.5"));
        QCOMPARE(changes.count(), 0);
    }

    void stepsAreRound() {
        RealSpinBox spin(0, 10);
        QSignalSpy edits(&spin, &RealSpinBox::edited);
        spin.setValueText(QStringLiteral("0.3"));
        spin.stepBy(1);
        QCOMPARE(spin.valueText(), QStringLiteral("0.31"));
        spin.setValueText(QStringLiteral("2.5"));
        spin.stepBy(-3);
        QCOMPARE(spin.valueText(), QStringLiteral("2.2"));
        spin.setValueText(QStringLiteral("9.95"));
        spin.stepBy(1);
        QCOMPARE(spin.valueText(), QStringLiteral("10"));
        spin.stepBy(1);
        QCOMPARE(spin.valueText(), QStringLiteral("10"));
        QCOMPARE(edits.count(), 3);
        spin.setValueText(QStringLiteral("0"));
        spin.stepBy(1);
        QVERIFY(spin.valueText().toDouble() > 0);
        RealSpinBox wide(0, 1e6);
        wide.setValueText(QStringLiteral("125000"));
        wide.stepBy(1);
        QCOMPARE(wide.valueText(), QStringLiteral("135000"));
    }

    void theDefaultComesBack() {
        Options changed;
        changed.min_speed = 0.5;
        changed.layers = 70;
        ParameterForm form;
        form.setParameters(list(changed), list());
        form.show();
        QVERIFY(form.isModified());
        QVERIFY(row(form, "motion.min_speed")->isModified());
        QVERIFY(!row(form, "motion.link_radius")->isModified());
        auto* reset = row(form, "motion.min_speed")->findChild<QToolButton*>();
        QVERIFY(reset->isVisible());
        QVERIFY(!row(form, "motion.link_radius")->findChild<QToolButton*>()->isVisible());
        QSignalSpy changes(&form, &ParameterForm::valueChanged);
        reset->click();
        QCOMPARE(changes.count(), 1);
        QCOMPARE(changes[0][1].toString(), QStringLiteral("0.0066667"));
        QVERIFY(!reset->isVisible());
        form.resetAll();
        QCOMPARE(changes.count(), 2);
        QVERIFY(!form.isModified());
        form.resetAll();
        QCOMPARE(changes.count(), 2);
    }

    void theSameNumberInOtherWordsIsNotModified() {
        auto current = list();
        current[0].value = "6.6667e-3";
        ParameterForm form;
        form.setParameters(current, list());
        QVERIFY(!form.isModified());
        QCOMPARE(form.values()[0].second, std::string("6.6667e-3"));
    }

    void searchLooksIntoNamesAndHelp() {
        Options changed;
        changed.layers = 70;
        ParameterForm form;
        form.setParameters(list(changed), list());
        form.show();
        form.setFilterText(QStringLiteral("stack"));
        QCOMPARE(shownRows(form), QStringList{QStringLiteral("stacking.layers")});
        form.setFilterText(QStringLiteral("linked CORNERS"));
        QCOMPARE(shownRows(form), QStringList{QStringLiteral("motion.link_radius")});
        form.setFilterText(QStringLiteral("§5.5.1"));
        QCOMPARE(shownRows(form), QStringList{QStringLiteral("removal.fuse")});
        form.setFilterText(QStringLiteral("nonsense"));
        QVERIFY(shownRows(form).isEmpty());
        bool explained = false;
        for (const QLabel* label : form.findChildren<QLabel*>()) {
            explained = explained || (label->isVisible() && label->text().contains(QStringLiteral("“nonsense”")));
        }
        QVERIFY(explained);
        form.setFilterText(QString());
        form.setModifiedOnly(true);
        QCOMPARE(shownRows(form), QStringList{QStringLiteral("stacking.layers")});
        form.setModifiedOnly(false);
        QCOMPARE(shownRows(form).size(), 5);
    }

    void aStoredRunIsOnlyRead() {
        Options changed;
        changed.layers = 70;
        ParameterForm form;
        form.setReadOnly(true);
        form.setParameters(list(changed), list());
        form.show();
        QSignalSpy changes(&form, &ParameterForm::valueChanged);
        auto* speed = field<RealSpinBox>(form, "motion.min_speed");
        type(speed, QStringLiteral("3"));
        speed->stepBy(1);
        field<QCheckBox>(form, "removal.fuse")->click();
        form.resetAll();
        QCOMPARE(changes.count(), 0);
        QVERIFY(row(form, "stacking.layers")->isModified());
        QVERIFY(!row(form, "stacking.layers")->findChild<QToolButton*>()->isVisible());
        form.setReadOnly(false);
        type(speed, QStringLiteral("3"));
        QCOMPARE(changes.count(), 1);
    }

    void theWheelScrollsAndDoesNotChangeValues() {
        ParameterForm form;
        form.setParameters(list(), list());
        form.show();
        auto* layers = field<QSpinBox>(form, "stacking.layers");
        form.setFocus();
        QVERIFY(!layers->hasFocus());
        QWheelEvent wheel(QPointF(5, 5), layers->mapToGlobal(QPointF(5, 5)), {}, QPoint(0, 120), Qt::NoButton,
                          Qt::NoModifier, Qt::NoScrollPhase, false);
        QApplication::sendEvent(layers, &wheel);
        QCOMPARE(layers->value(), 50);
    }

    void presetsAreChosenByName() {
        ParameterForm form;
        form.setPresets({QStringLiteral("default"), QStringLiteral("thesis")}, QStringLiteral("thesis"));
        auto* presets = form.findChild<QComboBox*>();
        QCOMPARE(presets->currentText(), QStringLiteral("thesis"));
        QSignalSpy chosen(&form, &ParameterForm::presetChosen);
        form.show();
        presets->setFocus();
        QTest::keyClick(presets, Qt::Key_Up);
        QCOMPARE(chosen.count(), 1);
        QCOMPARE(chosen[0][0].toString(), QStringLiteral("default"));
    }

    void newDeclarationsMakeNewRows() {
        ParameterForm form;
        form.setParameters(list(), list());
        auto fewer = list();
        fewer.pop_back();
        fewer[0].max = 20;
        form.setParameters(fewer, fewer);
        QCOMPARE(form.values().size(), std::size_t{4});
        form.setParameters({}, {});
        QVERIFY(form.values().empty());
    }

    void looksRightInBothThemes() {
        for (const bool dark : {false, true}) {
            Options changed;
            changed.layers = 70;
            ParameterForm form;
            if (dark) form.setPalette(ui::test::darkPalette());
            form.setPresets({QStringLiteral("default"), QStringLiteral("thesis")}, QStringLiteral("default"));
            form.setParameters(list(changed), list());
            form.resize(360, 520);
            form.show();
            QVERIFY(QTest::qWaitForWindowExposed(&form));
            ui::test::keepPicture(form, dark ? QStringLiteral("form_dark") : QStringLiteral("form_light"));
        }
    }
};

}  // namespace eyrie::ui::panels_parameter_form_test

EYRIE_UI_TEST(QApplication, panels_parameter_form_test, ParameterFormTest)
#include "panels_parameter_form_test.moc"
