#include "deploy/bench/report.h"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <iostream>
#include <sstream>

#include "deploy/bench/machine.h"
#include "deploy/json.h"

namespace shearwater::bench {

namespace {

std::string exact(double value) {
    std::ostringstream out;
    out << std::setprecision(9) << value;
    return std::isfinite(value) ? out.str() : "null";
}

std::string rounded(double value, int decimals) {
    std::ostringstream out;
    out << std::fixed << std::setprecision(decimals) << value;
    return out.str();
}

std::string heading(std::string key) {
    std::ranges::replace(key, '_', ' ');
    return key;
}

}  // namespace

Record& Record::text(const std::string& key, const std::string& value, std::size_t width) {
    fields_.push_back({key, deploy::quoted(value), value, true, width});
    return *this;
}

Record& Record::count(const std::string& key, std::uint64_t value) {
    fields_.push_back({key, std::to_string(value), std::to_string(value)});
    return *this;
}

Record& Record::number(const std::string& key, std::optional<double> value, int decimals) {
    fields_.push_back({key, value ? exact(*value) : "null", value ? rounded(*value, decimals) : "-"});
    return *this;
}

Record& Record::aside(const std::string& key, double value) {
    fields_.push_back({key, exact(value), {}});
    return *this;
}

Record& Record::aside(const std::string& key, const std::string& value) {
    fields_.push_back({key, deploy::quoted(value), {}});
    return *this;
}

base::Result<Report> Report::open(const std::string& benchmark, const std::string& json) {
    Report report;
    report.benchmark_ = benchmark;
    report.json_ = json;
    if (!json.empty() && json != "-") {
        report.file_.open(json);
        if (!report.file_) {
            return base::error(base::Code::io, "write " + json, "cannot be written");
        }
    }
    const Machine machine = this_machine();
    if (!json.empty()) {
        deploy::JsonObject line(report.lines());
        line.add("bench", deploy::quoted(benchmark)).add("machine", to_json(machine)).end();
        report.lines() << std::endl;
    }
    if (json != "-") {
        std::cout << to_line(machine) << std::endl;
    }
    return report;
}

std::ostream& Report::lines() {
    return json_ == "-" ? std::cout : file_;
}

void Report::table(const std::string& name, const std::string& title) {
    table_ = name;
    widths_.clear();
    note("\n" + title);
}

void Report::add(const Record& record) {
    if (json_ != "-") {
        show(record);
    }
    if (!json_.empty()) {
        deploy::JsonObject line(lines());
        line.add("bench", deploy::quoted(benchmark_));
        if (!table_.empty()) {
            line.add("table", deploy::quoted(table_));
        }
        for (const Record::Field& field : record.fields()) {
            line.add(field.key, field.json);
        }
        line.end();
        lines() << std::endl;
    }
}

void Report::show(const Record& record) {
    const auto put = [](const Record::Field& field, const std::string& text, std::size_t width) {
        const std::string gap(width - std::min(width, text.size()), ' ');
        std::cout << (field.to_the_left ? text + gap : gap + text) << "  ";
    };
    if (widths_.empty()) {
        for (const Record::Field& field : record.fields()) {
            if (field.shown) {
                const std::string title = heading(field.key);
                constexpr std::size_t narrowest = 6;
                widths_.push_back(std::max({title.size(), field.shown->size(), field.width, narrowest}));
                put(field, title, widths_.back());
            }
        }
        std::cout << "\n";
    }
    auto width = widths_.begin();
    for (const Record::Field& field : record.fields()) {
        if (field.shown) {
            put(field, *field.shown, *width++);
        }
    }
    std::cout << std::endl;
}

void Report::note(const std::string& sentence) {
    if (json_ != "-") {
        std::cout << sentence << std::endl;
    }
}

base::Status Report::close() {
    if (!json_.empty() && !lines().flush()) {
        return base::error(base::Code::io, "write " + json_, "cannot be written");
    }
    return {};
}

}  // namespace shearwater::bench
