// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <variant>

#include "envs/task_registry.h"
#include "src/files/output_file.h"
#include "src/plot/label_places.h"
#include "src/plot/recordings.h"
#include "src/plot/space_picture.h"
#include "src/plot/time_histories.h"
#include "src/plot/track.h"
#include "src/plot/tracks_picture.h"
#include "tests/error_message.h"
#include "tests/scratch_directory.h"
#include "tests/src/plot/legible.h"
#include "tests/tolerance.h"

namespace skein {
namespace {

using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::Pair;
using ::testing::StartsWith;
using ::testing::UnorderedElementsAre;

/// A climbing turn at 1000 ft/s across the heading of 180 degrees.
std::string FlightRows(int episode, double target_yaw) {
  std::string rows;
  for (int k = 0; k <= 100; ++k) {
    const double yaw = 150 + 0.6 * k, t = 0.1 * k;
    rows += fmt::format("{},{},{},{},{},60,5,{},{},22000,{},{},{},{}\n", episode, t, -1000 * t,
                        100 * t, 20000 + 200 * t, std::remainder(yaw, 360), k == 0 ? "" : "0.5",
                        target_yaw, 2000 - 200 * t, std::remainder(target_yaw - yaw, 360),
                        k == 100 ? "target_reached" : "");
  }
  return rows;
}

class FlightPictures : public ::testing::Test {
 protected:
  std::string Write(const std::string& name, int episodes,
                    const std::string& quantity = "altitude_ft") {
    std::string text = fmt::format(
        "episode,time_s,north_ft,east_ft,altitude_ft,roll_deg,pitch_deg,yaw_deg,action_roll,"
        "target_{0},target_yaw_deg,error_{0},error_yaw_deg,termination\n",
        quantity);
    for (int episode = 0; episode < episodes; ++episode) text += FlightRows(episode, -160);
    WriteFile(scratch_ / name, text);
    return scratch_ / name;
  }

  static std::vector<std::string> WordsOf(const Picture& picture) {
    std::vector<std::string> all;
    for (const Words& words : WordsIn(picture)) all.push_back(words.text);
    return all;
  }

  /// All lines and areas lie on the paper, too.
  static void ExpectOnThePaper(const Picture& picture) {
    for (const Shape& shape : picture.shapes) {
      const auto* const path = std::get_if<Path>(&shape);
      if (path == nullptr) continue;
      for (const PagePoint& point : path->points) {
        EXPECT_GE(point.x, 0);
        EXPECT_LE(point.x, picture.width);
      }
    }
  }

  Recordings TwoAgents(int episodes) {
    Recordings recordings =
        ReadRecordings({Write("f.policy.csv", episodes), Write("f.autopilot.csv", episodes)});
    Choose({{}, {}, {{"altitude_ft", 100}, {"yaw_deg", 5}}}, &recordings);
    return recordings;
  }

  /// As in missions: from `first_row` on the aircraft is to be at another altitude.
  static void GiveNewTarget(std::size_t first_row, double altitude_ft, CsvColumns* table) {
    const auto column = std::find(table->names.begin(), table->names.end(), "target_altitude_ft");
    std::vector<double>& targets =
        table->values[static_cast<std::size_t>(column - table->names.begin())];
    std::fill(targets.begin() + static_cast<std::ptrdiff_t>(first_row), targets.end(), altitude_ft);
  }

  const ScratchDirectory scratch_;
};

TEST_F(FlightPictures, AgentsOfTheSameEpisodesShareColumns) {
  const Recordings recordings = TwoAgents(2);
  const std::vector<DrawnEpisode> episodes = EpisodesOf(recordings);
  ASSERT_EQ(episodes.size(), 2u);
  EXPECT_EQ(episodes[1].flights.size(), 2u);
  EXPECT_EQ(recordings.agents[0].name, "policy");
  const Picture picture = TimeHistories(recordings, {{}, 518, "Two flights"});
  const std::vector<std::string> words = WordsOf(picture);
  for (const char* wanted :
       {"episode 0", "episode 1", "target reached; 10.0\u00a0s flown", "policy", "autopilot",
        "altitude, ft", "yaw, deg", "roll action, -1 to 1", "time, s", "tolerance", "target",
        "Two flights"}) {
    EXPECT_THAT(words, Contains(wanted));
  }
  ExpectLegible(picture);
}

TEST_F(FlightPictures, AgentsOfTheSameNameAreCalledByTheirFiles) {
  const auto names_of = [](const std::vector<std::string>& files) {
    std::vector<std::string> names;
    for (const Recording& agent : ReadRecordings(files).agents) names.push_back(agent.name);
    return names;
  };
  for (const char* folder : {"a", "b"}) std::filesystem::create_directory(scratch_ / folder);
  const std::string a = Write("a/flights.csv", 1), b = Write("b/flights.csv", 1);
  const std::string zero = Write("a/flights.zero.csv", 1);
  EXPECT_THAT(names_of({a, zero}), ElementsAre("flights", "zero"));
  EXPECT_THAT(names_of({a, zero, b}), ElementsAre(a, "zero", b));
}

TEST_F(FlightPictures, ColumnsOfAPaperHoldArrowsAndWords) {
  constexpr double kColumn = 252;  // 3.5 in
  for (const int episodes : {1, 4}) {
    const Recordings recordings = TwoAgents(episodes);
    for (const Picture& picture : {TracksPicture(recordings, {std::nullopt, kColumn, ""}),
                                   SpacePicture(recordings, {25, 28, std::nullopt, kColumn, ""})}) {
      ExpectLegible(picture);
      ExpectOnThePaper(picture);
    }
  }
}

TEST_F(FlightPictures, AnglesHaveNoJumpsAndTargetsLieBesideThem) {
  const Recordings recordings = ReadRecordings({Write("f.csv", 1)});
  const DrawnFlight& flight = recordings.agents[0].flights[0];
  const std::vector<PagePoint> flown = flight.Flown("yaw_deg"), target = flight.Target("yaw_deg");
  constexpr double kText = 1e-4;  // degrees: files hold 6 digits
  for (std::size_t k = 0; k < flown.size(); ++k) {
    EXPECT_NEAR(flown[k].y, 150 + 0.6 * static_cast<double>(k), kText);
    EXPECT_NEAR(target[k].y, 200, kText);
  }
}

TEST_F(FlightPictures, SpaceShowsEachEndAndItsScales) {
  const Picture picture = SpacePicture(TwoAgents(1), {});
  const std::vector<std::string> words = WordsOf(picture);
  EXPECT_EQ(std::count(words.begin(), words.end(), "10.0 s"), 2);
  for (const char* wanted : {"N", "start", "altitude,", "north,", "east,",
                             "target heading at target altitude (±5°, ±100\u00a0ft)"}) {
    EXPECT_THAT(words, Contains(wanted));
  }
  ExpectLegible(picture);
}

TEST_F(FlightPictures, TheStartIsBesideTheNumbersOfACorner) {
  std::string text =
      "episode,time_s,north_ft,east_ft,altitude_ft,roll_deg,pitch_deg,yaw_deg,"
      "termination\n";
  for (int t = 0; t <= 60; ++t) {
    text += fmt::format("0,{},{},{},{},0,0,90,\n", t, 7000 - 7000 * std::exp(-t / 8.0), 950 * t,
                        21000 - 1000 * std::exp(-t / 8.0));
  }
  WriteFile(scratch_ / "turn.csv", text);
  ExpectLegible(SpacePicture(ReadRecordings({scratch_ / "turn.csv"}), {}));
}

/// On the paper.
double LengthOf(const Path& path) {
  const PagePoint &a = path.points[0], &b = path.points[1];
  return std::hypot(b.x - a.x, b.y - a.y);
}

/// Lines in a picture of one flight of the first agent in space, points.
struct SpaceLengths {
  double ground = 0;     ///< a side of it
  double post = 0;       ///< from the flight's end down to the ground
  double tolerance = 0;  ///< of the target altitude, from its lower to its upper end
};

SpaceLengths LengthsIn(const Picture& picture) {
  SpaceLengths lengths;
  lengths.ground = LengthOf(std::get<Path>(picture.shapes.front()));
  for (const Shape& shape : picture.shapes) {
    const auto* const path = std::get_if<Path>(&shape);
    if (path == nullptr || path->points.size() != 2) continue;
    if (path->stroke == ColourOf(0) && path->opacity < 1) lengths.post = LengthOf(*path);
    if (path->stroke == kInk && path->width == 2) lengths.tolerance = LengthOf(*path);
  }
  return lengths;
}

TEST_F(FlightPictures, AVerticalScaleEnlargesFlightsPostsAndTolerancesAlike) {
  constexpr Tolerance kRounding{1e-9, "float64 rounding of points on the page"};
  constexpr double kAltitude_ft = 22000, kFloor_ft = 19600, kTolerance_ft = 100;
  const Recordings recordings = TwoAgents(1);
  SpaceOptions options;
  options.vertical_scale = 1;
  const Picture equal = SpacePicture(recordings, options);
  const SpaceLengths before = LengthsIn(equal);
  EXPECT_THAT(WordsOf(equal), Contains("shadow on the grid at 19,600\u00a0ft"));
  EXPECT_THAT(WordsOf(equal), Not(Contains(HasSubstr("enlarged"))));
  for (const double scale : {2.0, 7.5}) {
    options.vertical_scale = scale;
    const Picture picture = SpacePicture(recordings, options);
    const SpaceLengths lengths = LengthsIn(picture);
    EXPECT_NEAR(lengths.post / lengths.ground, scale * before.post / before.ground, kRounding);
    EXPECT_NEAR(lengths.tolerance / lengths.post, 2 * kTolerance_ft / (kAltitude_ft - kFloor_ft),
                kRounding);
    EXPECT_THAT(WordsOf(picture), Contains(fmt::format("altitude enlarged {:g} times", scale)));
    ExpectLegible(picture);
    ExpectOnThePaper(picture);
  }
}

TEST(VerticalScale, IsThePowerOfTwoThatBringsFlatFlightsNearestToAFifth) {
  constexpr double kHorizontal_ft = 120000;
  for (const double steep : {0.0, 0.1, 0.15, 3.0}) {
    EXPECT_EQ(DefaultVerticalScale(steep * kHorizontal_ft, kHorizontal_ft), 1) << steep;
  }
  EXPECT_EQ(DefaultVerticalScale(3000, kHorizontal_ft), 8);
  for (const double flat : {1e-6, 0.004, 0.01, 0.03, 0.06, 0.0999}) {
    const double chosen = DefaultVerticalScale(flat * kHorizontal_ft, kHorizontal_ft);
    EXPECT_THAT((std::vector<double>{2, 4, 8, 16, 32}), Contains(chosen));
    for (const double other : {2.0, 4.0, 8.0, 16.0, 32.0}) {
      EXPECT_LE(std::abs(chosen * flat - 0.2), std::abs(other * flat - 0.2)) << flat;
    }
  }
}

TEST_F(FlightPictures, MapsHaveEqualScales) {
  constexpr Tolerance kRounding{1e-12, "float64 rounding of some hundred points on the page"};
  const Picture picture = TracksPicture(TwoAgents(1), {});
  const std::vector<std::string> words = WordsOf(picture);
  for (const char* wanted : {"N", "start", "north, 1000 ft", "east, 1000 ft", "altitude, 1000 ft",
                             "time, s", "target altitude"}) {
    EXPECT_THAT(words, Contains(wanted));
  }
  // The path of 10,000 ft to the south and 1000 ft to the east is the longest line of its colour.
  PagePoint span;
  for (const Shape& shape : picture.shapes) {
    const auto* const path = std::get_if<Path>(&shape);
    if (path == nullptr || path->stroke != ColourOf(0) || path->is_closed) continue;
    const PagePoint own{path->points.back().x - path->points.front().x,
                        path->points.back().y - path->points.front().y};
    if (own.y > span.y) span = own;
  }
  EXPECT_NEAR(span.x / span.y, 0.1, kRounding);
}

TEST_F(FlightPictures, FitAColumnOfAPaper) {
  constexpr double kColumn = 3.5 * 72;
  const Recordings one = TwoAgents(1);
  for (const Picture& picture :
       {TimeHistories(one, {{}, kColumn, ""}), SpacePicture(one, {25, 28, {}, kColumn, ""}),
        TracksPicture(one, {{}, kColumn, ""})}) {
    EXPECT_EQ(picture.width, kColumn);
    ExpectLegible(picture);
    for (const Shape& shape : picture.shapes) {
      const auto* const words = std::get_if<Words>(&shape);
      if (words != nullptr) {
        EXPECT_GE(words->size, 7) << words->text;
      }
    }
  }
  EXPECT_THAT(MessageOf([&] {
                TimeHistories(TwoAgents(9), {{}, kColumn, ""});
              }),
              HasSubstr("9 episodes do not fit side by side"));
}

TEST_F(FlightPictures, ANarrowMapOfAWideFlightHasAScale) {
  std::string text =
      "episode,time_s,north_ft,east_ft,altitude_ft,roll_deg,pitch_deg,yaw_deg,termination\n";
  for (const int side : {-1, 1}) {
    for (int k = 0; k <= 10; ++k) {
      text += fmt::format("{},{},{},{},20000,0,0,{},{}\n", (side + 1) / 2, 3 * k, 1000 * k,
                          side * 3000 * k, 70 * side, k == 10 ? "target_reached" : "");
    }
  }
  WriteFile(scratch_ / "wide.csv", text);
  const Picture picture = TracksPicture(ReadRecordings({scratch_ / "wide.csv"}), {{}, 252, ""});
  ExpectLegible(picture);
  EXPECT_THAT(WordsOf(picture), Contains("20"));
}

TEST_F(FlightPictures, AFileThatIsCutShortIsDrawnAsFarAsItGoes) {
  const std::string file = Write("f.csv", 2);
  const std::string text = ReadFile(file);
  WriteFile(file, text.substr(0, text.size() - 40));
  const Recordings recordings = ReadRecordings({file});
  EXPECT_THAT(recordings.notes, ElementsAre(HasSubstr("1 row cut short and left out")));
  EXPECT_THAT(EndOf(recordings.agents[0].flights[1]), StartsWith("9.9"));
  EXPECT_EQ(EpisodesOf(recordings).size(), 2u);
}

/// Dashed lines of a picture by colour, without the legend's sample.
std::map<Colour, int> DashedLines(const Picture& picture) {
  std::map<Colour, int> counts;
  for (const Shape& shape : picture.shapes) {
    const auto* const path = std::get_if<Path>(&shape);
    if (path != nullptr && path->dash == Dash::kDashed) ++counts[*path->stroke];
  }
  --counts[kInk];
  return counts;
}

TEST_F(FlightPictures, AgentsWithOtherTargetsHaveThemInTheirColours) {
  const Picture same = TimeHistories(TwoAgents(1), {});
  EXPECT_THAT(DashedLines(same), ElementsAre(Pair(kInk, 2)));
  EXPECT_THAT(WordsOf(same), Contains("target"));
  Recordings recordings = TwoAgents(1);
  GiveNewTarget(50, 21000, &recordings.agents[1].flights[0].table);
  const Picture other = TimeHistories(recordings, {});
  EXPECT_THAT(DashedLines(other),
              UnorderedElementsAre(Pair(ColourOf(0), 1), Pair(ColourOf(1), 1), Pair(kInk, 1)));
  EXPECT_THAT(WordsOf(other), Contains(StartsWith("target; in the agents' colours")));
}

TEST_F(FlightPictures, EveryTargetOfAMissionIsMarkedWhereItWasLeft) {
  Recordings recordings = TwoAgents(1);
  const auto arrows = [&recordings](Colour colour) {
    const std::vector<Shape> shapes = TracksPicture(recordings, {}).shapes;
    return std::count_if(shapes.begin(), shapes.end(), [colour](const Shape& shape) {
      const auto* const path = std::get_if<Path>(&shape);
      return path != nullptr && path->stroke == colour && path->width == 1;
    });
  };
  EXPECT_EQ(arrows(ColourOf(1)), 0);
  GiveNewTarget(50, 21000, &recordings.agents[1].flights[0].table);
  const std::vector<Track> tracks = TracksOf(recordings);
  EXPECT_EQ(tracks[0].targets.size(), 1u);
  ASSERT_EQ(tracks[1].targets.size(), 2u);
  EXPECT_EQ(tracks[1].targets[0].place,
            SpacePoint(tracks[1].points[49].x(), tracks[1].points[49].y(), 22000));
  EXPECT_EQ(tracks[1].targets[1].place,
            SpacePoint(tracks[1].points.back().x(), tracks[1].points.back().y(), 21000));
  EXPECT_EQ(arrows(ColourOf(1)), 2);
  ExpectLegible(TracksPicture(recordings, {}));
}

TEST_F(FlightPictures, TolerancesStayInTheirPanels) {
  Recordings recordings = TwoAgents(1);
  Choose({{}, {}, {{"altitude_ft", 3000}, {"yaw_deg", 90}}}, &recordings);
  PageBox panel;
  int bands = 0;
  for (const Shape& shape : TimeHistories(recordings, {}).shapes) {
    const auto* const path = std::get_if<Path>(&shape);
    if (path == nullptr) continue;
    const bool is_axes = !path->is_closed && path->points.size() == 3 && path->stroke == kGrey;
    if (is_axes) panel = {0, path->points[0].y, 0, path->points[1].y};
    const bool is_band = path->is_closed && path->points.front().x != path->points[1].x;
    if (!is_band || bands == 2) continue;  // then the legend's
    ++bands;
    for (const PagePoint& point : path->points) {
      EXPECT_GE(point.y, panel.top);
      EXPECT_LE(point.y, panel.bottom);
    }
  }
  EXPECT_EQ(bands, 2);
}

TEST_F(FlightPictures, WhatIsNotDrawnIsNotExplained) {
  const std::string file = Write("f.csv", 1);
  std::string text = ReadFile(file);
  for (const std::string name : {"target_yaw_deg", "error_yaw_deg"}) {
    text.replace(text.find(name), name.size(), "x" + name);  // no target any more
  }
  WriteFile(file, text);
  const Recordings recordings = ReadRecordings({file});
  for (const Picture& picture : {TracksPicture(recordings, {}), SpacePicture(recordings, {})}) {
    EXPECT_THAT(WordsOf(picture), Not(Contains(StartsWith("target heading"))));
  }
}

TEST_F(FlightPictures, TheSeventhAgentHasDashes) {
  std::vector<std::string> files;
  for (int agent = 0; agent < 7; ++agent) files.push_back(Write(fmt::format("f.{}.csv", agent), 1));
  const Recordings recordings = ReadRecordings(files);
  for (const Picture& picture : {TimeHistories(recordings, {}), TracksPicture(recordings, {}),
                                 SpacePicture(recordings, {})}) {
    int dashed = 0;
    for (const Shape& shape : picture.shapes) {
      const auto* const path = std::get_if<Path>(&shape);
      dashed += path != nullptr && path->dash == Dash::kDashed && path->stroke == ColourOf(6);
    }
    EXPECT_GT(dashed, 1) << "a flight and its sample";
  }
}

TEST_F(FlightPictures, FlightsThatWentAsAskedHaveNoEnd) {
  AgentFlights flown;
  flown.agent = "autopilot";
  flown.targets = MakeTask(flown.env)->target_quantities();
  RecordedStep step;
  step.target.resize(flown.targets.size());
  flown.flights.push_back({{}, step.target, std::vector<RecordedStep>(100, step), {}});
  const auto end = [&](Termination termination, double mission_s) {
    flown.flights[0].steps.back().termination = termination;
    flown.env.mission.length_s = mission_s;
    return EndOf(RecordingsOf({flown}).agents[0].flights[0]);
  };
  EXPECT_EQ(end(Termination::kNone, 0), "2.0\u00a0s flown");
  EXPECT_EQ(end(Termination::kTimeLimit, 2), "2.0\u00a0s flown") << "a mission to its end";
  EXPECT_EQ(end(Termination::kTimeLimit, 0), "time limit; 2.0\u00a0s flown");
  EXPECT_EQ(end(Termination::kLowAltitude, 2), "low altitude; 2.0\u00a0s flown");
}

TEST_F(FlightPictures, AFileShowsAMissionByItsNewTargets) {
  const auto end = [&](const std::string& last_target, const std::string& termination) {
    WriteFile(scratch_ / "mission.csv",
              "episode,time_s,altitude_ft,target_altitude_ft,termination\n"
              "0,0,900,1000,\n0,1,990,1000,\n0,2,1000," +
                  last_target + "," + termination + "\n");
    return EndOf(ReadRecordings({scratch_ / "mission.csv"}).agents[0].flights[0]);
  };
  EXPECT_EQ(end("2000", "time_limit"), "2.0\u00a0s flown") << "a mission to its end";
  EXPECT_EQ(end("2000", "low_altitude"), "low altitude; 2.0\u00a0s flown");
  EXPECT_EQ(end("1000", "time_limit"), "time limit; 2.0\u00a0s flown");
}

TEST_F(FlightPictures, ARecordingMayBeginAtAnyTime) {
  constexpr Tolerance kRounding{1e-6, "of times of some thousand s in float64, on the page"};
  const auto recorded = [&](double start_s) {
    std::string rows =
        "episode,time_s,north_ft,east_ft,altitude_ft,roll_deg,pitch_deg,yaw_deg,termination\n";
    for (int k = 0; k < 60; ++k) {
      rows += fmt::format("0,{},{},0,{},0,0,0,\n", start_s + 0.1 * k, 50 * k, 20000 + k);
    }
    WriteFile(scratch_ / "recording.csv", rows);
    return ReadRecordings({scratch_ / "recording.csv"});
  };
  /// Where lines in the agent's colour begin and end.
  const auto ends = [](const Picture& picture) {
    std::vector<double> across;
    for (const Shape& shape : picture.shapes) {
      const auto* const path = std::get_if<Path>(&shape);
      if (path == nullptr || path->is_closed || path->stroke != ColourOf(0)) continue;
      across.insert(across.end(), {path->points.front().x, path->points.back().x});
    }
    return across;
  };
  const Recordings early = recorded(0), late = recorded(1000);
  EXPECT_EQ(EndOf(early.agents[0].flights[0]), "5.9\u00a0s flown");
  EXPECT_EQ(EndOf(late.agents[0].flights[0]), "5.9\u00a0s flown");
  const auto expect_alike = [&](const Picture& a, const Picture& b) {
    const std::vector<double> wanted = ends(a), drawn = ends(b);
    ASSERT_FALSE(wanted.empty());
    ASSERT_EQ(drawn.size(), wanted.size());
    for (std::size_t k = 0; k < wanted.size(); ++k) EXPECT_NEAR(drawn[k], wanted[k], kRounding);
  };
  HistoryOptions histories;
  histories.columns = {"altitude_ft"};
  expect_alike(TimeHistories(early, histories), TimeHistories(late, histories));
  expect_alike(TracksPicture(early, {}), TracksPicture(late, {}));
}

TEST_F(FlightPictures, WhatCannotBeDrawnIsSaid) {
  const std::string flights = Write("a.csv", 2), other = Write("b.csv", 2, "height_ft");
  const auto choosing = [&](const RecordingChoice& choice) {
    return MessageOf([&] {
      Recordings recordings = ReadRecordings({flights});
      Choose(choice, &recordings);
    });
  };
  EXPECT_THAT(MessageOf([&] {
                ReadRecordings({flights, other});
              }),
              HasSubstr("b.csv: flights of another task"));
  EXPECT_THAT(choosing({{}, {7}, {}}), HasSubstr("no episode 7; known: 0, 1"));
  EXPECT_THAT(choosing({{}, {}, {{"speed", 20}}}),
              HasSubstr("speed has no target; these have: altitude_ft, yaw_deg"));
  EXPECT_THAT(choosing({{"x", "y"}, {}, {}}), HasSubstr("2 names for 1 agent"));
  EXPECT_THAT(MessageOf([&] { ReadRecordings({scratch_ / "nowhere.csv"}); }),
              HasSubstr("nowhere.csv"));
  WriteFile(scratch_ / "empty.csv", "");
  EXPECT_THAT(MessageOf([&] { ReadRecordings({scratch_ / "empty.csv"}); }),
              HasSubstr("empty.csv: no column episode"));
  WriteFile(scratch_ / "none.csv", "episode,time_s,termination\n");
  EXPECT_THAT(MessageOf([&] { ReadRecordings({scratch_ / "none.csv"}); }),
              HasSubstr("none.csv: holds no flights"));
  WriteFile(scratch_ / "bare.csv", "episode,time_s,termination\n0,0,\n");
  EXPECT_THAT(
      MessageOf([&] { SpacePicture(ReadRecordings({scratch_ / "bare.csv"}), SpaceOptions()); }),
      HasSubstr("bare.csv: no column north_ft"));
}

TEST_F(FlightPictures, RowsOutOfOrderAreRefused) {
  const std::string file = scratch_ / "rows.csv";
  const auto complaint = [&](const std::string& rows) {
    WriteFile(file, "episode,time_s,termination\n" + rows);
    return MessageOf([&] { ReadRecordings({file}); });
  };
  EXPECT_EQ(complaint("1,0,\n1,0.5,\n0,0,\n0,0.5,\n"), "") << "episodes in any order";
  for (const char* rows : {"0,0.5,\n0,0,\n", "0,0,\n0,0,\n", "0,0,\n1,0,\n0,0.5,\n"}) {
    EXPECT_THAT(complaint(rows), HasSubstr("rows.csv: rows of episode 0 are not together"));
  }
  EXPECT_THAT(complaint("nan,0,\n"), HasSubstr("a cell of column episode holds no number"));
}

TEST_F(FlightPictures, WhatIsTooFarAwayIsRefused) {
  const std::string file = scratch_ / "far.csv";
  for (const char* place : {"1e20,0,20000,0", "0,-1e20,20000,0", "0,0,1e20,0", "0,0,0,1e20"}) {
    WriteFile(file, fmt::format("episode,time_s,roll_deg,pitch_deg,yaw_deg,north_ft,east_ft,"
                                "altitude_ft,target_altitude_ft,termination\n0,0,0,0,0,{},\n",
                                place));
    const auto is_refused = HasSubstr("far.csv: episode 0 or its target is 1e+20 ft away");
    EXPECT_THAT(MessageOf([&] { SpacePicture(ReadRecordings({file}), SpaceOptions()); }),
                is_refused);
    EXPECT_THAT(MessageOf([&] { TracksPicture(ReadRecordings({file}), TracksOptions()); }),
                is_refused);
  }
}

}  // namespace
}  // namespace skein
