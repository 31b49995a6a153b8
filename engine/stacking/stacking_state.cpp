// What image stacking remembers between frames, as bytes and back.
#include "core/error.h"
#include "core/state_archive.h"
#include "stacking/image_stacker.h"

namespace eyrie {

template <class Archive>
void transfer(Archive& archive, MasterPose& pose) {
    archive(pose.position, pose.heading, pose.velocity);
}

template <class Archive>
void MasterVector::Related::transfer(Archive& archive) {
    archive(id, offset, turn);
}

template <class Archive>
void MasterVector::transfer(Archive& archive) {
    archive(id_, pose_, related_);
    for (std::size_t i = 1; i < related_.size(); ++i) {
        archive.require(related_[i - 1].id < related_[i].id, "related vectors in disorder");
    }
}

template <class Archive>
void StackLayer::transfer(Archive& archive) {
    if (ready_) throw Error(ErrorKind::internal, "a stack layer of ready pixels belongs to no picture");
    gray_ = archive.picture(frame_, gray_);
    archive(image_from_stack_);
}

template <class Archive>
void ImageStack::transfer(Archive& archive) {
    if (arrangement_ == StackArrangement::accumulation) {
        archive(sum_, height_);
        archive.require(sum_.size() == size_ && sum_.type() == CV_32SC1 && height_ >= 0, "a stack of another size");
        return;
    }
    archive.items(layers_, [&] { return StackLayer(cv::Mat(1, 1, CV_8UC1), {}, size_); });
    archive(next_);
    height_ = static_cast<int>(layers_.size());
    archive.require(height_ <= capacity_ && next_ >= 0 && next_ < capacity_, "a stack that is too high");
}

template <class Archive>
void ImageStacker::Entry::transfer(Archive& archive) {
    archive(master, stack);
}

template <class Archive>
void ImageStacker::transfer(Archive& archive) {
    archive.items(entries_, [&] {
        return Entry{MasterVector(0, {}), ImageStack(options_.arrangement, area_, options_.capacity)};
    });
    archive(owner_, remembered_, next_id_);
}

template void ImageStacker::transfer(StateWriter&);
template void ImageStacker::transfer(StateReader&);

}  // namespace eyrie
