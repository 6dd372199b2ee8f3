// SPDX-License-Identifier: Apache-2.0
#include "src/commands/plot_command.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <functional>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <utility>

#include "base/ends_with.h"
#include "base/number_text.h"
#include "src/agents/agent_names.h"
#include "src/commands/flown_agents.h"
#include "src/config/number_in.h"
#include "src/config/usage_error.h"
#include "src/config/whole_number.h"
#include "src/evaluation/evaluation_report.h"
#include "src/files/output_file.h"
#include "src/files/text_table.h"
#include "src/plot/picture_file.h"
#include "src/plot/space_picture.h"
#include "src/plot/time_histories.h"
#include "src/plot/tracks_picture.h"
#include "src/plot/training_curves.h"
#include "src/run/run_directory.h"

namespace skein {
namespace {

using Json = nlohmann::json;

constexpr int kDefaultEpisodes = 4;
constexpr double kPointsPerInch = 72;

/// What all kinds of pictures have in common.
struct PaperOptions {
  std::string out, title;
  CLI::Option* out_option = nullptr;
  double width_in = 7.2;

  double width() const { return kPointsPerInch * width_in; }
};

/// And those of flights.
struct FlightPlotOptions {
  PaperOptions paper;
  FlownAgents flown;
  std::vector<std::string> files, columns, tolerances;
  RecordingChoice choice;
};

/// And those of flights in space.
struct PlacesPlotOptions {
  FlightPlotOptions flights;
  std::optional<double> interval_s;
};

struct CurvePlotOptions {
  PaperOptions paper;
  std::vector<std::string> runs, names, comparisons;
  std::optional<int> seeds;
  CurveOptions curves;
};

void AddPaperOptions(CLI::App* command, const std::string& kind, PaperOptions* paper) {
  paper->out = kind + ".svg";
  paper->out_option =
      command
          ->add_option("-o,--out", paper->out,
                       "the picture: SVG or PDF by the ending of its name (PDF needs cairo)")
          ->type_name("FILE")
          ->capture_default_str();
  command->add_option("--title", paper->title, "words above the picture")->type_name("TEXT");
  command
      ->add_option("--width", paper->width_in,
                   "of the picture, in; letters keep their 8 points: 3.5 is a column of a paper")
      ->type_name("INCHES")
      ->transform(NumberIn(2.5, 60))
      ->capture_default_str();
}

void AddFlightSources(CLI::App* command, FlightPlotOptions* options) {
  options->flown.flight.episodes = kDefaultEpisodes;
  command
      ->add_option("files", options->files,
                   "files of flights (skein replay --format csv, or --flights of eval and "
                   "compare), one for each agent")
      ->type_name("FLIGHTS.csv...");
  AddFlownAgents(command, &options->flown);
  command
      ->add_option("--names", options->choice.names,
                   "what the agents are called, in the order of the files or of --agents")
      ->type_name("NAME,...")
      ->delimiter(',');
  command
      ->add_option("--show", options->choice.episodes,
                   "numbers of the episodes that are drawn (default: the first that have room)")
      ->type_name("I,J,...")
      ->delimiter(',')
      ->transform(WholeNumber(0, kMostRecordedEpisodes - 1));
  command
      ->add_option("--tolerance", options->tolerances,
                   "errors that count as reached, of files, which do not hold them, such as "
                   "altitude_ft=100,yaw_deg=5")
      ->type_name("COLUMN=X,...")
      ->delimiter(',');
}

std::map<std::string, double> TolerancesIn(const std::vector<std::string>& texts) {
  std::map<std::string, double> tolerances;
  for (const std::string& text : texts) {
    const std::size_t equals = text.find('=');
    const auto value =
        equals == std::string::npos ? std::optional<double>() : ReadNumber(text.substr(equals + 1));
    if (!value) throw UsageError(fmt::format("--tolerance {}: give COLUMN=NUMBER", text));
    const std::string column = text.substr(0, equals);
    const double largest = LargestTolerance(column);
    if (!(*value > 0 && *value <= largest)) {
      throw UsageError(fmt::format("--tolerance {}: give a number above 0, up to {}", text,
                                   ShortestText(largest)));
    }
    tolerances[column] = *value;
  }
  return tolerances;
}

/// Whether the flights are to be flown, and not read.
bool AreFlown(const FlightPlotOptions& options) {
  return !options.flown.policy.empty() || !options.flown.agents.empty();
}

/// Throws UsageError if a policy or a run is named where files of flights are.
void RequireNoPolicies(const std::vector<std::string>& files) {
  for (const std::string& file : files) {
    if (!EndsWith(file, ".skein") && !IsRunDirectory(file)) continue;
    throw UsageError(fmt::format("{0}: not a file of flights; did you mean --policy {0}?", file));
  }
}

Recordings RecordingsFor(const FlightPlotOptions& options, const CLI::App& command) {
  const bool flies = AreFlown(options);
  if (options.files.empty() != flies) {
    throw UsageError(flies ? "give files of flights, or --policy and --agents, not both"
                           : "give files of flights, or --policy or --agents: who flies?");
  }
  if (!flies) {
    RequireNoPolicies(options.files);
    RequireNotGiven(command, {"--task", "--preset", "--config", "--aircraft", "--condition",
                              "--set", "--hold", "--mission", "--episodes", "--seed"});
  }
  RecordingChoice choice = options.choice;
  choice.tolerances = TolerancesIn(options.tolerances);
  Recordings recordings =
      flies ? RecordingsOf(FlyEpisodes(options.flown)) : ReadRecordings(options.files);
  AsUsage([&] { Choose(choice, &recordings); });
  return recordings;
}

/// The files that the flights come from.
std::vector<std::string> FilesRead(const FlightPlotOptions& options) {
  return AreFlown(options) ? FilesRead(options.flown) : options.files;
}

/// Draws what `draw` returns, after it is known that the file can be written and is none of those
/// that are `read`, and says so, and what `draw` has noted.
void WriteTo(const PaperOptions& paper, const std::vector<std::string>& read,
             const std::function<Picture(std::vector<std::string>* notes)>& draw) {
  CheckPictureFile(paper.out);
  CheckWritable({paper.out}, read);
  std::vector<std::string> notes;
  Picture picture = draw(&notes);
  const std::string name = OutputName(paper.out, paper.out_option->count() == 0);
  WritePicture(paper.out, std::move(picture));
  for (const std::string& note : notes) fmt::print(stderr, "note: {}\n", note);
  fmt::print("{}\n", name);
}

void AddFlightsPlot(CLI::App* plot) {
  auto options = std::make_shared<FlightPlotOptions>();
  CLI::App* command = plot->add_subcommand(
      "flights", "Flights over time: what was asked for, what was flown, and the actions");
  AddFlightSources(command, options.get());
  command
      ->add_option("--columns", options->columns,
                   "columns of files of flights, from top to bottom, such as "
                   "alpha_deg,load_factor_g,elevator_deg (default: targets, then actions)")
      ->type_name("COLUMN,...")
      ->delimiter(',');
  AddPaperOptions(command, "flights", &options->paper);
  command->footer(
      "Example: skein plot flights --policy runs/short --agents autopilot -o flights.pdf\n"
      "         skein plot flights flights.csv --show 2 --width 3.5 --columns "
      "altitude_ft,alpha_deg,load_factor_g");
  command->callback([options, command] {
    WriteTo(options->paper, FilesRead(*options), [&](std::vector<std::string>* notes) {
      Recordings recordings = RecordingsFor(*options, *command);
      *notes = recordings.notes;
      const int room = MostHistories(options->paper.width());
      if (options->choice.episodes.empty()) KeepFirstEpisodes(room, &recordings);
      return TimeHistories(recordings,
                           {options->columns, options->paper.width(), options->paper.title});
    });
  });
}

/// Adds a kind of picture of episodes in space; `draw` makes it.
CLI::App* AddPlaces(CLI::App* plot, const char* kind, const char* help,
                    const std::shared_ptr<PlacesPlotOptions>& options,
                    const std::function<Picture(const Recordings&)>& draw) {
  CLI::App* command = plot->add_subcommand(kind, help);
  AddFlightSources(command, &options->flights);
  command
      ->add_option("--interval", options->interval_s,
                   "seconds between two aircraft (default: so many that they do not touch)")
      ->type_name("SECONDS")
      ->transform(NumberAboveZero());
  AddPaperOptions(command, kind, &options->flights.paper);
  command->callback([options, draw, command] {
    const FlightPlotOptions& flights = options->flights;
    WriteTo(flights.paper, FilesRead(flights), [&](std::vector<std::string>* notes) {
      const Recordings recordings = RecordingsFor(flights, *command);
      *notes = recordings.notes;
      return draw(recordings);
    });
  });
  return command;
}

void AddSpacePlot(CLI::App* plot) {
  auto options = std::make_shared<PlacesPlotOptions>();
  auto view = std::make_shared<SpaceOptions>();
  CLI::App* command = AddPlaces(plot, "space", "Flights in space, with aircraft in their attitudes",
                                options, [options, view](const Recordings& recordings) {
                                  view->interval_s = options->interval_s;
                                  view->width = options->flights.paper.width();
                                  view->title = options->flights.paper.title;
                                  return SpacePicture(recordings, *view);
                                });
  command->add_option("--azimuth", view->azimuth_deg, "compass direction of the view")
      ->type_name("DEG")
      ->transform(FiniteNumber())
      ->capture_default_str();
  command->add_option("--elevation", view->elevation_deg, "how far it looks down")
      ->type_name("DEG")
      ->transform(NumberIn(1, 89))
      ->capture_default_str();
  command
      ->add_option("--vertical-scale", view->vertical_scale,
                   "altitudes are drawn so many times as high (default: 1, or a power of two up to "
                   "32 where flights are flat)")
      ->type_name("N")
      ->transform(NumberIn(1, 100));
  command->footer(
      "Aircraft are those of the first agent; the others' flights are lines.\n"
      "Example: skein plot space --policy runs/short --agents autopilot -o space.pdf\n"
      "         skein plot space flights.csv --show 0,3 --azimuth -20 --width 3.5");
}

void AddTracksPlot(CLI::App* plot) {
  auto options = std::make_shared<PlacesPlotOptions>();
  AddPlaces(plot, "tracks", "Flights on a map, and their altitudes over time", options,
            [options](const Recordings& recordings) {
              const PaperOptions& paper = options->flights.paper;
              return TracksPicture(recordings, {options->interval_s, paper.width(), paper.title});
            })
      ->footer("Example: skein plot tracks --policy runs/short --episodes 8 -o tracks.pdf");
}

/// What the autopilot of a file of --comparison was flown in.
struct FlownComparison {
  std::string path, task, conditions;
  Json environment;  ///< by key; null of a file that does not say
};

/// Adds the task, and the name and success rate of the first autopilot, in what skein compare
/// --json wrote.
FlownComparison ReadComparison(const std::string& path, CurveOptions* curves) {
  const Json report = Json::parse(ReadFile(path), nullptr, /*allow_exceptions=*/false);
  try {
    for (const Json& agent : report.at("agents")) {
      const auto name = agent.at("name").get<std::string>();
      if (!IsAutopilot(name)) continue;
      const auto task = report.at("task").get<std::string>();
      curves->autopilots[task] = {AutopilotVariantOf(name) + " autopilot",
                                  agent.at("success_rate").get<double>()};
      return {path, task, report.value("conditions", ""), report.value("environment", Json())};
    }
  } catch (const Json::exception&) {
    throw Error(path + ": not what skein compare --json writes");
  }
  throw Error(path + ": compares no autopilot; name one in skein compare --agents");
}

/// Keys of the environment whose values in evaluations of a run are not those of `flown`. A key
/// that only one version of Skein knows tells nothing.
std::vector<std::string> KeysThatDiffer(const Json& flown, const RunRecord& run) {
  std::vector<std::string> keys;
  const Json own = EnvironmentJson(run.config);
  for (const auto& [key, value] : own.items()) {
    if (flown.contains(key) && flown.at(key) != value) keys.push_back(key);
  }
  return keys;
}

/// Says which runs of the task are evaluated in another environment than the autopilot was flown
/// in.
void NoteOtherConditions(const FlownComparison& flown, const std::vector<CurveSetting>& settings,
                         std::vector<std::string>* notes) {
  std::vector<std::string> paths;
  std::set<std::string> keys;
  for (const CurveSetting& setting : settings) {
    for (const RunRecord& run : setting.runs) {
      if (setting.task != flown.task) continue;
      const std::vector<std::string> own = KeysThatDiffer(flown.environment, run);
      if (!own.empty()) paths.push_back(run.path);
      keys.insert(own.begin(), own.end());
    }
  }
  if (paths.empty()) return;
  notes->push_back(
      fmt::format("{}: its autopilot was flown under other conditions than {} ({}): {}", flown.path,
                  fmt::join(paths, ", "), fmt::join(keys, ", "), flown.conditions));
}

/// Which runs the names of --names stand for: the shell has perhaps put them in an order of its
/// own.
void NoteNames(const std::vector<CurveSetting>& settings, std::vector<std::string>* notes) {
  for (const CurveSetting& setting : settings) {
    std::vector<std::string> paths;
    for (const RunRecord& run : setting.runs) paths.push_back(run.path);
    notes->push_back(fmt::format("{}: {}", setting.name, fmt::join(paths, ", ")));
  }
}

void DrawCurves(const CurvePlotOptions& options) {
  CurveOptions curves = options.curves;
  curves.width = options.paper.width();
  curves.title = options.paper.title;
  std::vector<FlownComparison> flown;
  for (const std::string& path : options.comparisons) {
    flown.push_back(ReadComparison(path, &curves));
    for (std::size_t i = 0; i + 1 < flown.size(); ++i) {
      if (flown[i].task != flown.back().task) continue;
      throw UsageError(fmt::format("{} and {} are both of task {}: one --comparison for each",
                                   options.comparisons[i], path, flown.back().task));
    }
  }
  std::vector<std::string> read = FilesOfRuns(options.runs);
  read.insert(read.end(), options.comparisons.begin(), options.comparisons.end());
  WriteTo(options.paper, read, [&](std::vector<std::string>* notes) {
    std::vector<RunRecord> runs;
    for (const std::string& path : options.runs) {
      runs.push_back(ReadRunRecord(path));
      const int torn = runs.back().metrics.rows_left_out;
      if (torn == 0) continue;
      notes->push_back(
          fmt::format("{}/metrics.csv: {} cut short and left out", path, Counted(torn, "row")));
    }
    std::vector<CurveSetting> settings =
        AsUsage([&] { return SettingsOf(std::move(runs), options.seeds, options.names); });
    if (!options.names.empty()) NoteNames(settings, notes);
    LeaveOutRunsWithoutValues(curves.columns, &settings, notes);
    for (const FlownComparison& comparison : flown) {
      NoteOtherConditions(comparison, settings, notes);
    }
    return TrainingCurves(settings, curves);
  });
}

void AddCurvesPlot(CLI::App* plot) {
  auto options = std::make_shared<CurvePlotOptions>();
  CLI::App* command = plot->add_subcommand("curves", "Training curves: mean and band over seeds");
  command->add_option("runs", options->runs, "directories of runs")
      ->type_name("RUN...")
      ->required();
  command
      ->add_option("--columns", options->curves.columns,
                   "columns of metrics.csv, a row of panels for each")
      ->type_name("COLUMN,...")
      ->delimiter(',')
      ->capture_default_str();
  command
      ->add_option("--seeds", options->seeds,
                   "so many runs in a row are seeds of one setting (default: those of one "
                   "configuration)")
      ->type_name("N")
      ->transform(WholeNumber(1, 1000));
  command
      ->add_option("--names", options->names,
                   "what the settings are called, in the order of the runs")
      ->type_name("NAME,...")
      ->delimiter(',');
  command
      ->add_option("--comparison", options->comparisons,
                   "what skein compare --json wrote of a task: its autopilot's success is a line; "
                   "may be repeated")
      ->type_name("FILE.json")
      ->allow_extra_args(false);
  command
      ->add_option("--machine", options->curves.machine,
                   "name of the processor, written at the axis of training minutes (those of the "
                   "quickest run)")
      ->type_name("TEXT");
  AddPaperOptions(command, "curves", &options->paper);
  command->footer(
      "Each task has a column of panels. An unfinished run is drawn as far as it has come.\n"
      "Example: skein plot curves runs/seed-1 runs/seed-2 runs/seed-3 -o seeds.pdf --width 3.5\n"
      "         skein plot curves runs/* --columns success_rate,return_mean,entropy");
  command->callback([options] { DrawCurves(*options); });
}

}  // namespace

void AddPlotCommand(CLI::App* app) {
  CLI::App* plot =
      app->add_subcommand("plot", "Draw flights and trainings for print, as SVG or PDF");
  plot->require_subcommand(1);
  AddSpacePlot(plot);
  AddTracksPlot(plot);
  AddFlightsPlot(plot);
  AddCurvesPlot(plot);
}

}  // namespace skein
