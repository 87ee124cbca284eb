#pragma once
// What a benchmark says: a table for people and lines of JSON for programs, row by row as they come.

#include <cstdint>
#include <fstream>
#include <optional>
#include <string>
#include <vector>

#include "common/base/result.h"

namespace shearwater::bench {

// One row. A field's key heads its column, underscores as spaces.
class Record {
  public:
    // `width`: of the column, when other rows have longer texts.
    Record& text(const std::string& key, const std::string& value, std::size_t width = 0);
    Record& count(const std::string& key, std::uint64_t value);
    // With so many decimals in the table, and all there are in JSON; a dash and null without a value.
    Record& number(const std::string& key, std::optional<double> value, int decimals);
    // Not in the table.
    Record& aside(const std::string& key, double value);
    Record& aside(const std::string& key, const std::string& value);

    struct Field {
        std::string key;
        std::string json;
        std::optional<std::string> shown;
        bool to_the_left = false;
        std::size_t width = 0;
    };
    const std::vector<Field>& fields() const { return fields_; }

  private:
    std::vector<Field> fields_;
};

class Report {
  public:
    // `json`: a file for the lines, "" for none, or "-" for standard output, which then has no table.
    // Begins with the machine.
    static base::Result<Report> open(const std::string& benchmark, const std::string& json);

    // Begins a table, one of several: its lines of JSON say which.
    void table(const std::string& name, const std::string& title);
    // A table's records have the same fields, so that they are columns.
    void add(const Record& record);
    // A sentence below the table.
    void note(const std::string& sentence);
    // Whether all lines could be written.
    base::Status close();

  private:
    std::ostream& lines();
    void show(const Record& record);

    std::string benchmark_;
    std::string table_;
    std::string json_;
    std::ofstream file_;
    std::vector<std::size_t> widths_;  // of the table's columns, once there is a row
};

}  // namespace shearwater::bench
