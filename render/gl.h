#pragma once
/// The OpenGL functions the canvas calls, as a table filled from the context. The types come from
/// glcorearb.h alone: nothing of the system's libGL is linked.

#include <GL/glcorearb.h>

namespace merge2d {

#define MERGE2D_GL_FUNCTIONS(X)                         \
  X(GLACTIVETEXTURE, ActiveTexture)                     \
  X(GLATTACHSHADER, AttachShader)                       \
  X(GLBINDBUFFER, BindBuffer)                           \
  X(GLBINDFRAMEBUFFER, BindFramebuffer)                 \
  X(GLBINDTEXTURE, BindTexture)                         \
  X(GLBINDVERTEXARRAY, BindVertexArray)                 \
  X(GLBLENDFUNC, BlendFunc)                             \
  X(GLBUFFERDATA, BufferData)                           \
  X(GLCHECKFRAMEBUFFERSTATUS, CheckFramebufferStatus)   \
  X(GLCLEAR, Clear)                                     \
  X(GLCLEARCOLOR, ClearColor)                           \
  X(GLCOMPILESHADER, CompileShader)                     \
  X(GLCREATEPROGRAM, CreateProgram)                     \
  X(GLCREATESHADER, CreateShader)                       \
  X(GLDELETESHADER, DeleteShader)                       \
  X(GLDISABLE, Disable)                                 \
  X(GLDRAWARRAYSINSTANCED, DrawArraysInstanced)         \
  X(GLENABLE, Enable)                                   \
  X(GLENABLEVERTEXATTRIBARRAY, EnableVertexAttribArray) \
  X(GLFRAMEBUFFERRENDERBUFFER, FramebufferRenderbuffer) \
  X(GLGENBUFFERS, GenBuffers)                           \
  X(GLGENFRAMEBUFFERS, GenFramebuffers)                 \
  X(GLGENRENDERBUFFERS, GenRenderbuffers)               \
  X(GLGENTEXTURES, GenTextures)                         \
  X(GLGENVERTEXARRAYS, GenVertexArrays)                 \
  X(GLGETERROR, GetError)                               \
  X(GLGETINTEGERV, GetIntegerv)                         \
  X(GLGETPROGRAMINFOLOG, GetProgramInfoLog)             \
  X(GLGETPROGRAMIV, GetProgramiv)                       \
  X(GLGETSHADERINFOLOG, GetShaderInfoLog)               \
  X(GLGETSHADERIV, GetShaderiv)                         \
  X(GLGETSTRING, GetString)                             \
  X(GLGETUNIFORMLOCATION, GetUniformLocation)           \
  X(GLLINKPROGRAM, LinkProgram)                         \
  X(GLPIXELSTOREI, PixelStorei)                         \
  X(GLREADPIXELS, ReadPixels)                           \
  X(GLRENDERBUFFERSTORAGE, RenderbufferStorage)         \
  X(GLBINDRENDERBUFFER, BindRenderbuffer)               \
  X(GLSCISSOR, Scissor)                                 \
  X(GLSHADERSOURCE, ShaderSource)                       \
  X(GLTEXBUFFER, TexBuffer)                             \
  X(GLTEXIMAGE2D, TexImage2D)                           \
  X(GLTEXPARAMETERI, TexParameteri)                     \
  X(GLUNIFORM1I, Uniform1i)                             \
  X(GLUNIFORM2F, Uniform2f)                             \
  X(GLUSEPROGRAM, UseProgram)                           \
  X(GLVERTEXATTRIBDIVISOR, VertexAttribDivisor)         \
  X(GLVERTEXATTRIBIPOINTER, VertexAttribIPointer)       \
  X(GLVERTEXATTRIBPOINTER, VertexAttribPointer)         \
  X(GLVIEWPORT, Viewport)

struct Gl {
#define MERGE2D_GL_MEMBER(TYPE, NAME) PFN##TYPE##PROC NAME = nullptr;
  MERGE2D_GL_FUNCTIONS(MERGE2D_GL_MEMBER)
#undef MERGE2D_GL_MEMBER
};

}  // namespace merge2d
