#include <cstdio>
#include <exception>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "common/calibration/homography_fit.h"
#include "common/calibration/size_fit.h"
#include "common/io/annotation_file.h"
#include "common/io/correspondence_file.h"
#include "common/io/size_model_file.h"
#include "common/io/table_file.h"

namespace puck {
namespace {

struct Files {
  std::filesystem::path input;
  std::filesystem::path output;
};

// As a person would type it again; becomes a comment in the output.
std::string command_of(int argc, char** argv) {
  std::string command = std::filesystem::path(argv[0]).filename();
  for (int i = 1; i < argc; ++i) command += std::string(" ") + argv[i];
  return command;
}

void calibrate_size(const Files& files, const std::string& command) {
  std::vector<SizeAnnotation> annotations;
  for (const Annotation& row : read_annotation_file(files.input)) {
    annotations.push_back({row.time, row.centre, row.size});
  }
  const SizeFit fit = fit_puck_size_model(annotations);
  write_size_model_file(files.output, fit.model, command);
  std::printf("%zu annotations\n", annotations.size());
  std::printf("residual     rms px    max px\n");
  std::printf("width      %8.3f  %8.3f\n", fit.width.rms_px, fit.width.max_px);
  std::printf("height     %8.3f  %8.3f\n", fit.height.rms_px, fit.height.max_px);
}

void calibrate_table(const Files& files, const std::string& command) {
  std::vector<TableCorrespondence> correspondences;
  for (const Correspondence& row : read_correspondence_file(files.input)) {
    correspondences.push_back({row.image, row.table});
  }
  const HomographyFit fit = fit_homography(correspondences);
  write_table_file(files.output, {fit.homography, TableGeometry{}}, command);
  std::printf("%zu correspondences\n", correspondences.size());
  std::printf("residual        rms       max\n");
  std::printf("image, px  %8.3f  %8.3f\n", fit.rms_px, fit.max_px);
  std::printf("table, mm  %8.3f  %8.3f\n", fit.rms_m * 1e3, fit.max_m * 1e3);
  if (correspondences.size() == 4) {
    std::printf("four correspondences always fit: mark more to see how good they are\n");
  }
}

int run(int argc, char** argv) {
  CLI::App app("Fits the puck's size in the image and the place of the table.", "puck-calibrate");
  app.set_version_flag("--version", PUCK_VERSION);
  app.require_subcommand(1);
  Files files;
  CLI::App* size = app.add_subcommand("size", "The puck's size as a function of where it is");
  size->add_option("annotations", files.input, "CSV: t_us,x,y,width,height")->required();
  CLI::App* table = app.add_subcommand("table", "The homography from the image to the table");
  table->add_option("correspondences", files.input, "CSV: x_px,y_px,x_m,y_m")->required();
  for (CLI::App* command : {size, table}) {
    command->add_option("--output", files.output, "TOML file to write")->required();
  }
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 2;
  }

  try {
    if (size->parsed()) {
      calibrate_size(files, command_of(argc, argv));
    } else {
      calibrate_table(files, command_of(argc, argv));
    }
  } catch (const std::invalid_argument& error) {
    // The fits do not know which file their rows come from.
    std::fprintf(stderr, "puck-calibrate: %s: %s\n", files.input.c_str(), error.what());
    return 1;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "puck-calibrate: %s\n", error.what());
    return 1;
  }
  return 0;
}

}  // namespace
}  // namespace puck

int main(int argc, char** argv) { return puck::run(argc, argv); }
