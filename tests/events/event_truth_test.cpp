#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>
#include <set>

#include "events/driven_tracks.h"
#include "scene/traffic/traffic.h"

namespace eyrie::event_truth_test {
namespace {

using test::DrivenTracks;
using test::Leg;

/// An event that happens by construction. Optional ones lie near a threshold: they may be found or not.
struct TrueEvent {
    EventKind kind = EventKind::appears;
    std::vector<TrackId> tracks;
    double frame = 0;
    bool optional = false;
};

/// A scene with all that happens in it, but for the kinds that are left open.
struct TrueScene {
    DrivenTracks scene;
    std::vector<Zone> zones;
    std::vector<TrueEvent> truth;
    std::set<EventKind> open;
};

struct Count {
    int right = 0, missed = 0, wrong = 0;
    double recall() const { return right / std::max(1.0, double(right + missed)); }
    double precision() const { return right / std::max(1.0, double(right + wrong)); }
};
using Counts = std::map<EventKind, Count>;

constexpr double kTolerance_s = 1.5;  ///< speeds are taken over one second

void compare(const TrueScene& truth, Counts& counts, std::string& differences) {
    const double tolerance = kTolerance_s * truth.scene.scale.frame_rate_hz;
    std::vector<Event> found = truth.scene.events({}, truth.zones);
    std::erase_if(found, [&](const Event& event) { return truth.open.count(event.kind) != 0; });
    const auto take = [&](const TrueEvent& wanted) {
        const auto same = std::find_if(found.begin(), found.end(), [&](const Event& event) {
            return event.kind == wanted.kind && event.tracks == wanted.tracks &&
                   wanted.frame >= event.first_frame - tolerance && wanted.frame <= event.last_frame + tolerance;
        });
        if (same == found.end()) return false;
        found.erase(same);
        return true;
    };
    for (const TrueEvent& wanted : truth.truth) {
        if (wanted.optional) continue;
        const bool right = take(wanted);
        ++(right ? counts[wanted.kind].right : counts[wanted.kind].missed);
        if (!right) {
            differences += std::string("missed: ") + nameOf(wanted.kind) + " of " +
                           testing::PrintToString(wanted.tracks) + " in " + std::to_string(wanted.frame) + "\n";
        }
    }
    for (const TrueEvent& allowed : truth.truth) {
        if (allowed.optional) take(allowed);
    }
    for (const Event& event : found) {
        ++counts[event.kind].wrong;
        differences += "wrong: " + testing::PrintToString(event) + "\n";
    }
}

/// What follows from where tracks begin and end.
void addBorderTruth(TrueScene& scene) {
    const DrivenTracks& driven = scene.scene;
    for (const EventTrack& track : driven.tracks) {
        const auto nearBorder = [&](const TrackedBox& box) {
            const cv::Point2d at = box.box.centre;
            return std::min({at.x, at.y, driven.size.width - at.x, driven.size.height - at.y}) < 60;
        };
        const TrackedBox& first = track.boxes.front();
        const TrackedBox& last = track.boxes.back();
        const bool early = first.frame < 40;
        if (first.frame > 0) scene.truth.push_back({EventKind::appears, {track.id}, double(first.frame), early});
        if (last.frame >= driven.frames - 1) continue;
        const bool left = driven.left.count(track.id) != 0;
        const bool unclear = last.frame >= driven.frames - 40 || (!left && nearBorder(last));
        scene.truth.push_back({EventKind::lost, {track.id}, double(last.frame), left || unclear});
        scene.truth.push_back({EventKind::leaves, {track.id}, double(last.frame), !left || unclear});
        if (left && !unclear) scene.truth.erase(scene.truth.end() - 2);
        if (!left && !unclear) scene.truth.pop_back();
    }
}

/// Chooses what varies from one scene to the next.
class Chance {
 public:
    explicit Chance(std::uint64_t seed) : random_(seed) {}
    double between(double low, double high) { return random_.uniform(low, high); }
    int frame(int low, int high) { return random_.uniform(low, high); }
    double sign() { return random_.uniform(0, 2) == 0 ? -1 : 1; }

 private:
    cv::RNG random_;
};

TrueScene emptyScene(Chance& chance) {
    TrueScene scene;
    const double gsd = chance.between(0.15, 0.3);
    scene.scene.scale.gsd_m_per_px = gsd;
    scene.scene.size = {static_cast<int>(200 / gsd), static_cast<int>(120 / gsd)};
    const int phase = chance.frame(0, 5000);
    const cv::Point2d middle(scene.scene.size.width / 2.0 - 500, scene.scene.size.height / 2.0 - 300);
    scene.scene.camera = [gsd, phase, middle](int frame) {
        const cv::Matx33d shift(1, 0, middle.x, 0, 1, middle.y, 0, 0, 1);
        // Begins at the height that the GSD belongs to.
        const double lower = std::sqrt(std::abs(cv::determinant(DrivenTracks::moving(gsd)(phase)))) * gsd;
        const cv::Matx33d unzoom(1 / lower, 0, 500 - 500 / lower, 0, 1 / lower, 300 - 300 / lower, 0, 0, 1);
        return shift * unzoom * DrivenTracks::moving(gsd)(phase + frame);
    };
    return scene;
}

TrueScene stopping(Chance& chance) {
    TrueScene s = emptyScene(chance);
    const double speed = chance.between(25, 50);
    const double brakes = speed / 3.6 / chance.between(1.5, 4);
    const bool long_stand = chance.sign() > 0;
    const double stands = long_stand ? chance.between(4, 12) : chance.between(1.5, 2);
    const int first = chance.frame(50, 150);
    const TrackId id =
        s.scene.drive({30, chance.between(40, 80)}, chance.between(-10, 10),
                      {{2, speed, speed}, {brakes, speed, 0}, {stands, 0, 0}, {3, 0, 30}, {2, 30, 30}}, first);
    const double stop = first + 25 * (2 + brakes);
    s.truth = {{EventKind::stops, {id}, stop}, {EventKind::starts, {id}, stop + 25 * stands}};
    // Speeds below the limit are those of the last instants of braking, too.
    if (long_stand) s.truth.push_back({EventKind::stands, {id}, stop + 12.5 * stands});
    return s;
}

TrueScene rolling(Chance& chance) {
    TrueScene s = emptyScene(chance);
    const double slow = chance.between(8, 11);
    s.scene.drive({20, chance.between(40, 80)}, chance.between(-10, 10),
                  {{3, 40, 40}, {3, 40, slow}, {2.5, slow, slow}, {2, slow, 40}, {2, 40, 40}}, 60);
    s.open = {EventKind::under_speed};
    return s;
}

TrueScene passing(Chance& chance) {
    TrueScene s = emptyScene(chance);
    const bool to_right = chance.sign() > 0;
    s.scene.drive({to_right ? -40.0 : 240.0, chance.between(30, 90)}, to_right ? 0 : 180,
                  {{40, chance.between(30, 80), chance.between(30, 80)}}, 0);
    return s;
}

TrueScene losing(Chance& chance) {
    TrueScene s = emptyScene(chance);
    s.scene.drive({40, chance.between(40, 80)}, chance.between(-20, 20),
                  {{chance.between(3, 7), chance.between(30, 50), chance.between(30, 50)}}, chance.frame(50, 300));
    return s;
}

TrueScene turning(Chance& chance) {
    TrueScene s = emptyScene(chance);
    const double seconds = chance.between(4, 9);
    const double slow = chance.between(10, 20);
    const TrackId id = s.scene.drive(
        {40, 60}, chance.between(-15, 15),
        {{4, 35, 35}, {1, 35, slow}, {seconds, slow, slow, chance.sign() * 180 / seconds}, {1, slow, 35}, {3, 35, 35}},
        60);
    s.truth = {{EventKind::turns_back, {id}, 60 + 25 * (5 + seconds / 2)}};
    s.open = {EventKind::under_speed};
    return s;
}

TrueScene bending(Chance& chance) {
    TrueScene s = emptyScene(chance);
    const double seconds = chance.between(2, 6);
    s.scene.drive({40, 60}, 0,
                  {{4, 35, 35}, {seconds, 20, 20, chance.sign() * chance.between(60, 120) / seconds}, {3, 20, 20}}, 60);
    return s;
}

TrueScene speeding(Chance& chance) {
    TrueScene s = emptyScene(chance);
    const bool fast = chance.sign() > 0;
    const double top = fast ? chance.between(110, 130) : chance.between(80, 92);
    const TrackId id = s.scene.drive({10, chance.between(40, 80)}, 0, {{2, top - 20, top}, {2.5, top, top}}, 60);
    if (fast) s.truth = {{EventKind::over_speed, {id}, 60 + 25 * 3.5}};
    return s;
}

TrueScene crawling(Chance& chance) {
    TrueScene s = emptyScene(chance);
    const bool slow = chance.sign() > 0;
    const double speed = slow ? chance.between(8, 10) : chance.between(14.5, 18);
    const double seconds = chance.between(7, 12);
    const TrackId id = s.scene.drive({20, chance.between(40, 80)}, chance.between(-20, 20),
                                     {{2, 40, 40}, {2, 40, speed}, {seconds, speed, speed}, {2, speed, 40}}, 60);
    if (slow) s.truth = {{EventKind::under_speed, {id}, 60 + 25 * (4 + seconds / 2)}};
    return s;
}

TrueScene loitering(Chance& chance) {
    TrueScene s = emptyScene(chance);
    s.scene.frames = 2500;
    const bool long_enough = chance.sign() > 0;
    const double seconds = long_enough ? chance.between(66, 90) : chance.between(30, 52);
    const double radius = chance.between(8, 20);
    const double speed = chance.between(15, 25);
    const double turn = chance.sign() * speed / 3.6 / radius * 180 / kPi;
    const TrackId id = s.scene.drive({100, 60}, chance.between(0, 360), {{seconds, speed, speed, turn}}, 60);
    if (long_enough) s.truth = {{EventKind::loiters, {id}, 60 + 12.5 * seconds}};
    s.open = {EventKind::turns_back};  // by going round and round
    return s;
}

/// Two come and stand beside each other, or one behind the other.
TrueScene meeting(Chance& chance) {
    TrueScene s = emptyScene(chance);
    const bool meet = chance.sign() > 0;
    const double stands = chance.between(7, 12);
    const double speed = chance.between(25, 35);
    const double way = speed / 3.6 * (2 + 1.5);
    const auto come = [&](double wait) {
        return std::vector<Leg>{{2, speed, speed}, {3, speed, 0}, {wait, 0, 0}, {3, 0, speed}, {1, speed, speed}};
    };
    const double beside = chance.between(2.5, 4);
    const TrackId a = s.scene.drive({100 - way, 60}, 0, come(stands + 1), 50);
    const double gap = chance.between(6, 7);
    const TrackId b = meet ? s.scene.drive({100 + way, 60 + beside}, 180, come(stands), 75)
                           : s.scene.drive({100 - gap - way, 60}, 0, come(stands + 1), 60);
    if (meet) s.truth = {{EventKind::meeting, {a, b}, 75 + 25 * (5 + stands / 2)}};
    s.open = {EventKind::stops, EventKind::starts, EventKind::stands, EventKind::under_speed};
    return s;
}

/// Three to five drive one after the other; or the gaps between them change, or they are but two.
TrueScene following(Chance& chance) {
    TrueScene s = emptyScene(chance);
    s.scene.frames = 1400;
    const int what = chance.frame(0, 3);
    const int vehicles = what == 0 ? chance.frame(3, 6) : what == 1 ? 2 : 4;
    const double speed = chance.between(14, 20);
    const double headway = chance.between(2.5, 4.2);
    std::vector<TrackId> ids;
    for (int i = 0; i < vehicles; ++i) {
        // Unsteady ones fall back by a tenth and more each.
        const double own = what == 2 ? speed * std::pow(0.82, i) : speed * chance.between(0.995, 1.005);
        ids.push_back(s.scene.drive({30, 40}, 0, {{15, own, own}, {6, own, own, 10}, {9, own, own}},
                                    50 + static_cast<int>(i * headway * 25)));
    }
    if (what == 0) s.truth = {{EventKind::convoy, ids, 50 + 25 * (headway * vehicles + 8)}};
    s.open = {EventKind::under_speed};
    return s;
}

/// Somebody drives through a zone and over a line, or past them.
TrueScene watching(Chance& chance) {
    TrueScene s = emptyScene(chance);
    const double y = chance.between(30, 90);
    const double angle = chance.between(-15, 15);
    const double speed = chance.between(30, 60);
    const TrackId id = s.scene.drive({30, y}, angle, {{30, speed, speed}}, 60);
    const int frame = chance.frame(0, 900);
    const auto seen = [&](cv::Point2d metres) { return HomographyJacobian(s.scene.camera(frame), metres).point(); };
    Zone area{"area", ZoneShape::area, ZoneAnchor::ground, frame, {}};
    for (const cv::Point2d corner : {cv::Point2d{70, 45}, {110, 45}, {110, 75}, {70, 75}})
        area.points.push_back(seen(corner));
    s.zones = {area, {"line", ZoneShape::line, ZoneAnchor::ground, frame, {seen({130, 20}), seen({130, 60})}}};
    const cv::Point2d direction(std::cos(radiansFromDegrees(angle)), std::sin(radiansFromDegrees(angle)));
    const auto whenAt = [&](double x) { return 60 + (x - 30) / direction.x / (speed / 3.6) * 25; };
    const auto heightAt = [&](double x) { return y + (x - 30) / direction.x * direction.y; };
    const auto inside = [&](double x) { return heightAt(x) > 45 && heightAt(x) < 75; };
    const bool unclear = std::min({std::abs(heightAt(70) - 45), std::abs(heightAt(70) - 75),
                                   std::abs(heightAt(110) - 45), std::abs(heightAt(110) - 75)}) < 1.5;
    if (inside(70) != inside(110) || unclear) {
        s.open = {EventKind::enters, EventKind::exits};
    } else if (inside(70)) {
        s.truth = {{EventKind::enters, {id}, whenAt(70)}, {EventKind::exits, {id}, whenAt(110)}};
    }
    const double at_line = heightAt(130);
    if (std::min(std::abs(at_line - 20), std::abs(at_line - 60)) < 1.5)
        s.open.insert(EventKind::crosses);
    else if (at_line > 20 && at_line < 60)
        s.truth.push_back({EventKind::crosses, {id}, whenAt(130)});
    return s;
}

/// Standing spans of true speeds, by the thresholds of the defaults.
void addStandTruth(TrueScene& scene, TrackId id, const MovingObject& object) {
    const EventTrack& track = scene.scene.tracks.back();
    bool standing = false;
    int since = 0;
    std::vector<std::pair<int, int>> spans;
    for (const TrackedBox& box : track.boxes) {
        const double kmh = 3.6 * object.poses[static_cast<std::size_t>(box.frame - object.first_frame)].speed;
        if (!standing && kmh < 2.5) standing = true, since = box.frame;
        if (standing && kmh > 6) standing = false, spans.emplace_back(since, box.frame);
    }
    if (standing) spans.emplace_back(since, track.boxes.back().frame);
    // Creeping on by less than a few metres is no drive.
    const auto creeps = [&](std::size_t before, std::size_t after) {
        if (after >= spans.size()) return false;
        const auto placeAt = [&](int frame) {
            return object.poses[static_cast<std::size_t>(frame - object.first_frame)].position;
        };
        const cv::Point2d way = placeAt(spans[after].first) - placeAt(spans[before].second);
        return std::hypot(way.x, way.y) < 4;
    };
    for (std::size_t i = 0; i < spans.size(); ++i) {
        const auto& [first, last] = spans[i];
        const double seconds = (last - first) / 25.0;
        const bool cut = last - track.boxes.front().frame < 75 || track.boxes.back().frame - first < 75;
        const bool cut_before = first - track.boxes.front().frame < 40 || (i > 0 && creeps(i - 1, i));
        const bool cut_after = track.boxes.back().frame - last < 40 || creeps(i, i + 1);
        scene.truth.push_back({EventKind::stops, {id}, double(first), seconds < 2.2 || cut || cut_before});
        scene.truth.push_back({EventKind::starts, {id}, double(last), seconds < 2.2 || cut || cut_after});
        scene.truth.push_back({EventKind::stands, {id}, (first + last) / 2.0, seconds < 4.2 || cut});
    }
}

/// Traffic of the scene renderer on two lanes with a light, one driver in the wrong lane and one who leaves the road.
TrueScene traffic(Chance& chance) {
    TrueScene s = emptyScene(chance);
    s.scene.frames = 2500;
    std::vector<Route> routes{{Path({{-40, 62}, {240, 62}}), {0}, {{150, {{15, 33}, {50, 68}}}}},
                              {Path({{240, 58.3}, {-40, 58.3}}), {0}, {}}};
    std::vector<Driver> drivers;
    for (int i = 0; i < 44; ++i) {
        Driver driver;
        driver.route = i % 2;
        driver.start = 0;
        driver.enter_time = i * 1.9 + chance.between(0, 1);
        driver.desired_speed = chance.between(10, 15);
        driver.drift = chance.between(-0.3, 0.3);
        drivers.push_back(driver);
    }
    for (const MovingObject& object : driveTraffic(routes, drivers, s.scene.frames, 25, 0)) {
        std::vector<std::pair<cv::Point2d, double>> poses;
        for (const ObjectPose& pose : object.poses)
            poses.emplace_back(pose.position, std::atan2(pose.direction.y, pose.direction.x));
        if (poses.empty()) continue;
        const TrackId id = s.scene.follow(poses, object.first_frame, object.look.length);
        if (s.scene.tracks.back().boxes.empty()) {
            s.scene.tracks.pop_back();
            continue;
        }
        addStandTruth(s, id, object);
    }
    const int wrong_at = chance.frame(1000, 1800);
    const double wrong_speed = chance.between(30, 50);
    const TrackId wrong = s.scene.drive({-20, 58.3}, 0, {{40, wrong_speed, wrong_speed}}, wrong_at);
    s.truth.push_back({EventKind::against_flow, {wrong}, wrong_at + 25 * 120 / (wrong_speed / 3.6)});
    // To the right, into the fields.
    const int leaves_at = chance.frame(1000, 1600);
    const double seconds = chance.between(2.5, 4);
    const TrackId leaver = s.scene.drive(
        {-30, 62}, 0,
        {{chance.between(7, 9), 40, 40}, {seconds, 25, 25, chance.between(50, 80) / seconds}, {5, 25, 25}}, leaves_at);
    s.truth.push_back({EventKind::leaves_flow, {leaver}, leaves_at + 25 * (8 + seconds + 2)});
    s.open = {EventKind::convoy, EventKind::under_speed};
    return s;
}

}  // namespace

TEST(EventTruth, RecallAndPrecisionAreHighForEveryKind) {
    using Make = TrueScene (*)(Chance&);
    const std::pair<Make, int> plan[] = {
        {stopping, 60}, {rolling, 20},   {passing, 40}, {losing, 40},    {turning, 60},  {bending, 30}, {speeding, 80},
        {crawling, 80}, {loitering, 60}, {meeting, 60}, {following, 60}, {watching, 80}, {traffic, 24}};
    Counts counts;
    std::string differences;
    std::uint64_t seed = 1;
    for (const auto& [make, times] : plan) {
        for (int i = 0; i < times; ++i) {
            Chance chance(seed++ * 7919);
            TrueScene scene = make(chance);
            addBorderTruth(scene);
            std::string found;
            compare(scene, counts, found);
            if (!found.empty()) differences += "scene " + std::to_string(seed - 1) + "\n" + found;
        }
    }
    for (const EventKind kind : allEventKinds()) {
        const Count& count = counts[kind];
        RecordProperty(nameOf(kind), std::to_string(count.right) + " right, " + std::to_string(count.missed) +
                                         " missed, " + std::to_string(count.wrong) + " wrong");
        EXPECT_GE(count.right, 20) << nameOf(kind);
        EXPECT_GE(count.recall(), 0.95) << nameOf(kind) << "\n" << differences;
        EXPECT_GE(count.precision(), 0.95) << nameOf(kind) << "\n" << differences;
    }
}

}  // namespace eyrie::event_truth_test
