//! What a device needs around `gsdf-nostd`: a picture for any display driver, a time-of-flight reading, the square
//! root of the FPU.
#![no_std]
