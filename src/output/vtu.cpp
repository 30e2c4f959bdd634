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

/// Cells of any kinds, one after another. type: 1 vertex, 3 line, 5 triangle, 10 tetrahedron.
class Cells {
 public:
  template <std::size_t corners>
  void add(const std::vector<std::array<int, corners>>& members, int type) {
    for (const auto& cell : members) {
      for (std::size_t c = 0; c < corners; ++c)
        connectivity_ += std::to_string(cell[c]) + (c + 1 < corners ? ' ' : '\n');
      offsets_ += std::to_string(end_ += corners) + '\n';
      types_ += std::to_string(type) + '\n';
    }
    count_ += members.size();
  }
  std::size_t count() const { return count_; }
  std::string text() const {
    return array("type=\"Int32\" Name=\"connectivity\"", connectivity_) +
           array("type=\"Int64\" Name=\"offsets\"", offsets_) +
           array("type=\"UInt8\" Name=\"types\"", types_);
  }

 private:
  std::size_t count_ = 0, end_ = 0;
  std::string connectivity_, offsets_, types_;
};

/// Those triangles of the surface that are of obstacles.
std::vector<std::array<int, 3>> triangles_of_obstacles(const Shape& shape) {
  std::vector<std::array<int, 3>> found;
  for (const auto& triangle : shape.surface)
    if (triangle[0] >= shape.particles - shape.obstacles) found.push_back(triangle);
  return found;
}

Cells cells(const Shape& shape) {
  Cells all;
  const auto of_obstacles = triangles_of_obstacles(shape);
  const bool by_surface = shape.tetrahedra.empty() && shape.lines.empty();
  if (!shape.tetrahedra.empty())
    all.add(shape.tetrahedra, 10);
  else if (!shape.lines.empty())
    all.add(shape.lines, 3);
  if (by_surface)
    all.add(shape.surface, 5);
  else
    all.add(of_obstacles, 5);
  if (by_surface && shape.surface.size() == of_obstacles.size()) {  // nothing shows the particles yet
    std::vector<std::array<int, 1>> vertices(static_cast<std::size_t>(shape.particles - shape.obstacles));
    for (std::size_t i = 0; i < vertices.size(); ++i) vertices[i] = {static_cast<int>(i)};
    all.add(vertices, 1);
  }
  all.add(shape.walls, 3);
  return all;
}

std::string fixed(const Shape& shape) {
  std::string text;
  for (int i = 0; i < shape.particles; ++i) text += "0\n";
  for (const int i : shape.fixed) text[2 * static_cast<std::size_t>(i)] = '1';
  for (int i = shape.particles - shape.obstacles; i < shape.particles; ++i)
    text[2 * static_cast<std::size_t>(i)] = '1';
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

/// What contacts do, if there are any.
std::string contacts(const Frame& frame) {
  if (frame.gap.empty()) return {};
  std::vector<double> gap = frame.gap;
  for (double& one : gap)
    if (!std::isfinite(one)) one = -1;
  return array("type=\"Float64\" Name=\"gap\"", column(gap)) +
         array("type=\"Float64\" Name=\"contact_force\" NumberOfComponents=\"3\"",
               rows_of_three(frame.contact_force));
}

std::string file(const std::string& type, const std::string& content) {
  return "<?xml version=\"1.0\"?>\n<VTKFile type=\"" + type + "\" version=\"1.0\">\n<" + type + ">\n" +
         content + "</" + type + ">\n</VTKFile>\n";
}

}  // namespace

void write_vtu(const std::filesystem::path& path, const Shape& shape, const Frame& frame) {
  check_frame(shape, frame);
  const Cells all = cells(shape);
  const std::string time =
      array("type=\"Float64\" Name=\"TimeValue\" NumberOfTuples=\"1\"", number(frame.time) + '\n');
  const std::string three = "NumberOfComponents=\"3\"";
  write_file(path,
             file("UnstructuredGrid",
                  "<FieldData>\n" + time + "</FieldData>\n<Piece NumberOfPoints=\"" +
                      std::to_string(shape.particles) + "\" NumberOfCells=\"" + std::to_string(all.count()) +
                      "\">\n" + "<Points>\n" +
                      array("type=\"Float64\" Name=\"position\" " + three, rows_of_three(frame.position)) +
                      "</Points>\n<Cells>\n" + all.text() + "</Cells>\n<PointData Vectors=\"velocity\">\n" +
                      array("type=\"Float64\" Name=\"velocity\" " + three, rows_of_three(frame.velocity)) +
                      array("type=\"UInt8\" Name=\"fixed\"", fixed(shape)) + clocks(frame) + contacts(frame) +
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
