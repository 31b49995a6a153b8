#pragma once

#include <cstdint>
#include <opencv2/core/types.hpp>
#include <string>
#include <vector>

#include "core/values/ids.h"
#include "scene/camera.h"
#include "scene/painting/surface.h"

/// A scene as data: what stands where, who moves how, what the camera does. Metres and seconds; see camera.h for the
/// axes. Presets fill it (scene_preset.h), SceneRenderer turns it into pictures and truth.
namespace eyrie {

/// What moves or stands in a scene.
enum class ObjectKind { car, van, truck, bus, motorcycle, bicycle, person };

/// The class word of box files: car, van, truck, bus, motorcycle, bicycle, person.
const char* nameOf(ObjectKind kind);
/// Car, van, truck or bus.
bool isVehicle(ObjectKind kind);

/// The outside of a vehicle or person.
struct ObjectLook {
    ObjectKind kind = ObjectKind::car;
    double length = 4.5;           ///< m
    double width = 1.8;            ///< m
    double height = 1.45;          ///< m
    cv::Vec3f colour{40, 40, 40};  ///< of the body: blue, green, red
    std::uint32_t seed = 1;        ///< chooses the details
};

/// Where an object is at one frame.
struct ObjectPose {
    cv::Point2d position;         ///< m, centre of the footprint
    cv::Point2d direction{1, 0};  ///< unit vector it points to
    double speed = 0;             ///< m/s
};

/// An object that moves (or stands in traffic) and is in the ground truth.
struct MovingObject {
    int id = 0;  ///< from 1, unique
    ObjectLook look;
    FrameIndex first_frame = 0;
    std::vector<ObjectPose> poses;  ///< one per frame of the scene's clock
};

/// A parked vehicle: in the picture, not in the truth.
struct ParkedVehicle {
    ObjectLook look;
    ObjectPose pose;
};

/// A painted part of the ground; later ones lie above earlier ones.
struct GroundPatch {
    std::vector<cv::Point2d> outline;
    Surface surface;
};

/// The roof of a house.
enum class RoofKind { flat, gable };

/// A house on the ground, metres.
struct Building {
    cv::Point2d centre;
    cv::Point2d direction{1, 0};  ///< along its length and ridge
    double length = 20;
    double width = 12;
    double height = 12;  ///< up to the eaves
    RoofKind roof = RoofKind::flat;
    Surface roof_surface{Material::roof_gravel};
    cv::Vec3f facade{150, 160, 165};
    std::uint32_t seed = 1;
};

/// A plain box: bus shelter, container, machine on a roof.
struct Block {
    cv::Point2d centre;
    cv::Point2d direction{1, 0};
    double length = 2;
    double width = 1;
    double bottom = 0;
    double top = 2;
    cv::Vec3f colour{120, 120, 120};
    bool shines = false;  ///< a sign with light of its own
};

/// A tree on the ground, metres.
struct Tree {
    cv::Point2d position;
    double height = 9;
    double crown_radius = 3;
    double density = 1;  ///< 1: full leaf; 0.3: nearly bare
    cv::Vec3f colour{48, 84, 62};
    std::uint32_t seed = 1;
};

/// A street lamp on the ground, metres.
struct LampPost {
    cv::Point2d position;
    cv::Point2d arm{1, 0};  ///< direction of the arm over the road, unit vector
    double height = 8;
    double arm_length = 2;
};

/// Where the light comes from, and how hard it is.
struct Sun {
    cv::Point2d shadow{0.5, 0.4};  ///< m of shadow on the ground per metre of height
    double ambient = 0.42;         ///< share of the light that reaches shadows; the rest is direct
};

/// Lamps, windows and vehicles shine while the sun is down; `Sun::ambient` is then what is left of daylight.
struct Night {
    bool lamps = false;                      ///< whether it is night
    cv::Vec3f lamp_tint{0.5F, 0.85F, 1.1F};  ///< of street lamps: blue, green, red
    double lamp_strength = 1;                ///< light below a lamp, as a share of full sunlight
    double beams = 0.6;                      ///< light of headlights on the road, likewise
    double windows = 0.2;                    ///< share of windows that are lit
};

/// What the camera and the radio link do to the picture.
struct Sensor {
    double blur_px = 0.35;     ///< deviation of lens blur, besides the pixel's own area
    double exposure = 0.2;     ///< share of the frame interval the shutter is open: motion blur
    double read_noise = 1.5;   ///< deviation, grey levels
    double shot_noise = 0.12;  ///< deviation at level v: this times √v
    double contrast = 0.8;     ///< around `level`
    double level = 118;        ///< where mid grey of the scene (120) comes to lie
    double haze = 0.05;        ///< share of white veil
    double vignette = 0.12;    ///< darkening of the corners
    int jpeg_quality = 0;      ///< 1 … 100; 0 without compression
    bool gray = false;         ///< a camera without colour
    double glare = 1;          ///< halos around lamps at night, 1: clean lens and clear air
    double fixed_pattern = 0;  ///< deviation of what sticks to the image: columns, pixels, cloudy shading; grey levels
    int smudges = 0;           ///< specks of dirt on the lens
    int samples = 16;          ///< per pixel, spread over its area and the exposure: 4, 8, 16 or 32
};

/// All that a rendered scene is made from.
struct SceneDescription {
    std::string name = "scene";
    std::string text;  ///< one sentence for people
    std::uint32_t seed = 1;
    int frame_count = 0;
    double frame_rate_hz = 25;
    double gsd_m_per_px = 0.3;  ///< typical, for users; the true one follows from the camera
    cv::Size image_size{640, 480};
    double least_length_px = 0;  ///< vehicles that look shorter are marked ignore
    bool upright_truth = false;  ///< the original's ground truth has upright boxes; ours is oriented all the same

    CameraPath camera;
    Sun sun;
    Night night;
    double sight_m = 0;                    ///< m over which haze leaves 37 % of contrast; 0: clear air
    cv::Vec3f haze_colour{176, 172, 168};  ///< blue, green, red
    Sensor sensor;
    Surface base{Material::grass};
    double map_margin = 25;  ///< m of ground painted beyond what the camera sees
    std::vector<GroundPatch> patches;
    std::vector<Building> buildings;
    std::vector<Block> blocks;
    std::vector<Tree> trees;
    std::vector<LampPost> posts;
    std::vector<ParkedVehicle> parked;
    std::vector<MovingObject> objects;

    /// Frame of the scene's clock that each frame of the video shows; empty: all in order. Repeats are frozen frames,
    /// jumps are dropped ones.
    std::vector<FrameIndex> shown;
};

/// Loses about this share of the frames as a bad radio link does: half of the events freeze the picture for one to
/// three frames, half drop one to three. `scene.frame_count` stays; frames beyond the scene's clock repeat its last.
void loseFrames(SceneDescription& scene, double share);

/// Map rectangle (m) that is painted: all that the camera sees of the ground, and the scene's margin about it.
cv::Rect2d mapArea(const SceneDescription& scene);

/// The scene's clock at a frame of the video.
FrameIndex clockFrame(const SceneDescription& scene, FrameIndex frame);

/// An object's pose at a moment of the scene's clock, between frames by interpolation; before its first and after its
/// last frame it does not exist (false).
bool poseAt(const MovingObject& object, double frame, ObjectPose& pose);

}  // namespace eyrie
