#include "client/model/picker.h"

namespace shearwater::model {

wire::Message Picker::ask(Purpose purpose, wire::PickRequest request) {
    request.revision = ++revision_;
    asked_ = Asked{revision_, purpose, request.at};
    return wire::message(wire::to_wire(request));
}

wire::Parsed<std::optional<Picked>> Picker::answer(const wire::pb::Picked& picked,
                                                   const std::optional<Cube>& cube) {
    if (!cube || picked.revision() == 0 || picked.revision() > revision_) {
        return wire::Fault{wire::pb::REASON_INVALID, "picked: of a pick that was not asked for"};
    }
    const auto answer = wire::pick_answer_from(picked, cube->lattice.n);
    if (!answer) {
        return answer.error();
    }
    if (!asked_ || answer->revision != asked_->revision) {
        return std::optional<Picked>();
    }
    const Picked made{asked_->purpose, asked_->at, answer->hit, answer->value, answer->incomplete};
    asked_.reset();
    return std::optional(made);
}

}  // namespace shearwater::model
