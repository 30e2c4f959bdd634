// SPDX-License-Identifier: MIT
// Frames in VTK's XML format. The format: https://docs.vtk.org/en/latest/design_documents/VTKFileFormats.html
#include "jetlag/output/vtu.hpp"

#include <cmath>
#include <stdexcept>

#include "jetlag/base/text.hpp"

namespace jetlag {

namespace {

/// Text inside an XML attribute.
std::string escaped(const std::string& text) {
  std::string safe;
  for (const char c : text) switch (c) {
      case '&': safe += "&amp;"; break;
      case '<': safe += "&lt;"; break;
      case '>': safe += "&gt;"; break;
      case '"': safe += "&quot;"; break;
      default: safe += c;
    }
  return safe;
}

std::string array(const std::string& attributes, const std::string& values) {
  return "<DataArray " + attributes + " format=\"ascii\">\n" + values + "</DataArray>\n";
}

/// One row a particle, three components each.
std::string rows_of_three(const Coordinates<double>& values) {
  std::string text;
  for (Eigen::Index i = 0; i < values.rows(); ++i)
    for (Eigen::Index c = 0; c < 3; ++c) {
      text += c < values.cols() ? number(values(i, c)) : "0";
      text += c < 2 ? ' ' : '\n';
    }
  return text;
}

struct Cells {
  std::size_t count;
  std::string text;
};

/// All cells have the same number of corners. type: 1 vertex, 3 line, 5 triangle, 10 tetrahedron.
template <std::size_t corners>
Cells cells(const std::vector<std::array<int, corners>>& members, int type) {
  std::string connectivity, offsets, types;
  std::size_t end = 0;
  for (const auto& cell : members) {
    for (std::size_t c = 0; c < corners; ++c)
      connectivity += std::to_string(cell[c]) + (c + 1 < corners ? ' ' : '\n');
    offsets += std::to_string(end += corners) + '\n';
    types += std::to_string(type) + '\n';
  }
  return {members.size(), array("type=\"Int32\" Name=\"connectivity\"", connectivity) +
                              array("type=\"Int64\" Name=\"offsets\"", offsets) +
                              array("type=\"UInt8\" Name=\"types\"", types)};
}

Cells cells(const Shape& shape) {
  if (!shape.tetrahedra.empty()) return cells(shape.tetrahedra, 10);
  if (!shape.lines.empty()) return cells(shape.lines, 3);
  if (!shape.surface.empty()) return cells(shape.surface, 5);
  std::vector<std::array<int, 1>> vertices(static_cast<std::size_t>(shape.particles));
  for (int i = 0; i < shape.particles; ++i) vertices[static_cast<std::size_t>(i)] = {i};
  return cells(vertices, 1);
}

std::string fixed(const Shape& shape) {
  std::string text;
  for (int i = 0; i < shape.particles; ++i) text += "0\n";
  for (const int i : shape.fixed) text[2 * static_cast<std::size_t>(i)] = '1';
  return text;
}

/// Numbers one to a line.
template <class T>
std::string column(const std::vector<T>& values) {
  std::string text;
  for (const T value : values) text += number(static_cast<double>(value)) + '\n';
  return text;
}

/// What the clocks of the particles showed, if it is known.
std::string clocks(const Frame& frame) {
  if (frame.step.empty()) return {};
  return array("type=\"Float64\" Name=\"step\"", column(frame.step)) +
         array("type=\"Int32\" Name=\"degree\"", column(frame.degree));
}

std::string file(const std::string& type, const std::string& content) {
  return "<?xml version=\"1.0\"?>\n<VTKFile type=\"" + type + "\" version=\"1.0\">\n<" + type + ">\n" +
         content + "</" + type + ">\n</VTKFile>\n";
}

}  // namespace

void write_vtu(const std::filesystem::path& path, const Shape& shape, const Frame& frame) {
  check_frame(shape, frame);
  const auto [count, text] = cells(shape);
  const std::string time =
      array("type=\"Float64\" Name=\"TimeValue\" NumberOfTuples=\"1\"", number(frame.time) + '\n');
  const std::string three = "NumberOfComponents=\"3\"";
  write_file(path,
             file("UnstructuredGrid",
                  "<FieldData>\n" + time + "</FieldData>\n<Piece NumberOfPoints=\"" +
                      std::to_string(shape.particles) + "\" NumberOfCells=\"" + std::to_string(count) +
                      "\">\n" + "<Points>\n" +
                      array("type=\"Float64\" Name=\"position\" " + three, rows_of_three(frame.position)) +
                      "</Points>\n<Cells>\n" + text + "</Cells>\n<PointData Vectors=\"velocity\">\n" +
                      array("type=\"Float64\" Name=\"velocity\" " + three, rows_of_three(frame.velocity)) +
                      array("type=\"UInt8\" Name=\"fixed\"", fixed(shape)) + clocks(frame) +
                      "</PointData>\n</Piece>\n"),
             Until::handed_over);
}

void write_pvd(const std::filesystem::path& path, const std::vector<double>& times,
               const std::vector<std::string>& files, Until until) {
  if (times.size() != files.size()) throw std::invalid_argument("write_pvd: each file needs its time");
  std::string list;
  for (std::size_t i = 0; i < files.size(); ++i) {
    if (!std::isfinite(times[i]))
      throw std::invalid_argument("write_pvd: the time of " + files[i] + " is not finite");
    list +=
        "<DataSet timestep=\"" + number(times[i]) + "\" part=\"0\" file=\"" + escaped(files[i]) + "\"/>\n";
  }
  write_file(path, file("Collection", list), until);
}

}  // namespace jetlag
